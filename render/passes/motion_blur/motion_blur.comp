#version 460
#extension GL_GOOGLE_include_directive : require
// Each pixel at moments of the open shutter. At each of them it sees what its own motion brings, unless that is hidden
// now; or, before that, what comes along the largest motion near it and lies nearer.
#include "render/picture_filter.glsl"
#include "render/passes/motion_blur/shutter.glsl"
layout(std430, binding = 2) readonly buffer Spread { vec2 spread[]; };
layout(std430, binding = 3) readonly buffer Vectors { vec2 vectors[]; };
layout(binding = 4) uniform sampler2D picture;

const float k_in_front = 1.02;  // nearer than this much: strands of a lock hold together
const float k_shortest = 0.25;  // pixels of motion that blur

// Whether something nearer is here at moment t of -1 .. 1, having come along `way`, and the pixel where it is now.
bool comes_before(vec2 middle, vec2 way, float t, float inverse, out ivec2 from) {
  from = pixel_at(middle - t * way, resolution);
  const uint index = index_of(from, resolution);
  const vec2 missed = t * (half_way(vectors[index]) - way);
  return pixel_depth[index] > k_in_front * inverse && length(missed) <= 1.0 + 0.2 * abs(t) * length(way);
}

vec4 at_moment(ivec2 pixel, vec2 own, vec2 largest_way, float t, float inverse) {
  const vec2 middle = vec2(pixel) + 0.5;
  ivec2 from;
  if (comes_before(middle, largest_way, t, inverse, from)) return texelFetch(picture, from, 0);
  from = pixel_at(middle - t * own, resolution);
  const bool hidden = pixel_depth[index_of(from, resolution)] > k_in_front * inverse;
  return texelFetch(picture, hidden ? pixel : from, 0);
}

void main() {
  const uint index = invocation();
  if (index >= resolution.x * resolution.y) return;
  const uvec2 pixel = uvec2(index % resolution.x, index / resolution.x), tile = pixel / k_tile;
  const vec2 near = spread[tile.y * tiles.x + tile.x];
  if (length(near) < k_shortest) {
    filtered[index] = texelFetch(picture, ivec2(pixel), 0);
    return;
  }
  const vec2 own = half_way(vectors[index]);
  const float part = turn_of(index) / 6.2831853;
  vec4 sum = vec4(0.0);
  for (uint k = 0u; k < samples; ++k)
    sum += at_moment(ivec2(pixel), own, near, 2.0 * (float(k) + part) / float(samples) - 1.0, pixel_depth[index]);
  filtered[index] = sum / float(samples);
}
