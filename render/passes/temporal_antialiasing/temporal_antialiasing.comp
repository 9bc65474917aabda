#version 460
#extension GL_GOOGLE_include_directive : require
// Each pixel: its picture, and what was there in the pictures before, kept within what the pixels around it now show.
#include "render/picture_filter.glsl"
layout(std430, binding = 2) readonly buffer Vectors { vec2 vectors[]; };   // pixels since the frame before
layout(std430, binding = 3) readonly buffer History { vec4 history[]; };  // the frame before, after this pass
layout(binding = 4) uniform sampler2D picture;
layout(push_constant) uniform Push {
  uvec2 resolution;
  float share;   // of this frame
  float spread;  // standard deviations
};

struct Around {
  vec4 mean, deviation;
  ivec2 nearest;  // the pixel that lies nearest: edges move as what is before them
};

Around look_around(ivec2 pixel) {
  vec4 sum = vec4(0.0), squares = vec4(0.0);
  float depth = -1.0;
  Around around;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const ivec2 there = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(resolution) - 1);
      const vec4 color = texelFetch(picture, there, 0);
      sum += color;
      squares += color * color;
      const float inverse = pixel_depth[index_of(there, resolution)];
      around.nearest = inverse > depth ? there : around.nearest;
      depth = max(depth, inverse);
    }
  around.mean = sum / 9.0;
  around.deviation = sqrt(max(squares / 9.0 - around.mean * around.mean, 0.0));
  return around;
}

vec4 remembered(ivec2 pixel) {
  return history[index_of(clamp(pixel, ivec2(0), ivec2(resolution) - 1), resolution)];
}

// Weights of the four samples around a place between the middle two (Catmull and Rom 1974).
vec4 spline_weights(float t) {
  const float s = 1.0 - t;
  return 0.5 * vec4(-t * s * s, 2.0 + t * t * (3.0 * t - 5.0), 2.0 + s * s * (3.0 * s - 5.0), -s * t * t);
}

vec4 remembered_at(vec2 place) {
  const vec2 corner = floor(place - 0.5);
  const vec4 wx = spline_weights(place.x - 0.5 - corner.x), wy = spline_weights(place.y - 0.5 - corner.y);
  vec4 sum = vec4(0.0);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) sum += wx[x] * wy[y] * remembered(ivec2(corner) + ivec2(x, y) - 1);
  return max(sum, 0.0);
}

void main() {
  const uint index = invocation();
  if (index >= resolution.x * resolution.y) return;
  const ivec2 pixel = ivec2(index % resolution.x, index / resolution.x);
  const vec4 now = texelFetch(picture, pixel, 0);
  const Around around = look_around(pixel);
  const vec2 then = vec2(pixel) + 0.5 - vectors[index_of(around.nearest, resolution)];
  const bool was_seen = all(greaterThanEqual(then, vec2(0.0))) && all(lessThan(then, vec2(resolution)));
  if (share >= 1.0 || !was_seen) {
    filtered[index] = now;
    return;
  }
  const vec4 reach = spread * around.deviation;
  const vec4 before = clamp(remembered_at(then), around.mean - reach, around.mean + reach);
  filtered[index] = mix(before, now, share);
}
