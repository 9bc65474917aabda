#version 460
#extension GL_GOOGLE_include_directive : require
// Each pixel gathers the discs that cover it. What lies before the pixel's own point covers it by the share of its light
// that falls here; the rest is a mean, to which a disc that lies behind gives no farther than the pixel's own disc
// reaches, so that what is sharp keeps its edge.
#include "render/picture_filter.glsl"
#include "render/passes/depth_of_field/lens.glsl"
layout(std430, binding = 2) readonly buffer Spread { float spread[]; };
layout(binding = 3) uniform sampler2D picture;

const float k_in_front = 1.02;  // nearer than this much: strands of a lock hold together

/// Light that a disc of radius `reach`, `apart` pixels away, sends onto a pixel, as a share of its own; the rim is a pixel wide.
float share(float reach, float apart) { return clamp(reach - apart + 0.5, 0.0, 1.0) / (3.14159265 * reach * reach); }

// The mean over the pixel's own disc, of what is not before it.
vec4 own_disc(uint index, vec2 middle, float inverse, float own) {
  const float turn = turn_of(index), area = 3.14159265 * own * own / float(samples);
  float weight = share(own, 0.0);
  vec4 sum = weight * texelFetch(picture, ivec2(middle), 0);
  for (uint k = 0u; k < samples; ++k) {
    const vec2 offset = own * disc_point(k, samples, turn);
    const ivec2 pixel = pixel_at(middle + offset, resolution);
    const float there = pixel_depth[index_of(pixel, resolution)];
    if (there > k_in_front * inverse) continue;
    const float given = area * share(min(blur_radius(there), own), length(offset));
    weight += given;
    sum += given * texelFetch(picture, pixel, 0);
  }
  return sum / weight;
}

// What the discs before the pixel put over it; their share of it grows into `covered`.
vec4 before(uint index, vec2 middle, float inverse, float widest, out float covered) {
  const float turn = turn_of(index), area = 3.14159265 * widest * widest / float(samples);
  covered = 0.0;
  vec4 sum = vec4(0.0);
  for (uint k = 0u; k < samples; ++k) {
    const vec2 offset = widest * disc_point(k, samples, turn);
    const ivec2 pixel = pixel_at(middle + offset, resolution);
    const float there = pixel_depth[index_of(pixel, resolution)];
    if (there <= k_in_front * inverse) continue;
    const float given = area * share(blur_radius(there), length(offset));
    covered += given;
    sum += given * texelFetch(picture, pixel, 0);
  }
  return sum;
}

void main() {
  const uint index = invocation();
  if (index >= resolution.x * resolution.y) return;
  const uvec2 pixel = uvec2(index % resolution.x, index / resolution.x), tile = pixel / k_tile;
  const vec2 middle = vec2(pixel) + 0.5;
  const float inverse = pixel_depth[index], own = blur_radius(inverse), widest = spread[tile.y * tiles.x + tile.x];
  vec4 color = own > k_point ? own_disc(index, middle, inverse, own) : texelFetch(picture, ivec2(pixel), 0);
  if (widest > k_point) {
    float covered;
    const vec4 front = before(index, middle, inverse, widest, covered);
    color = max(1.0 - covered, 0.0) * color + front / max(covered, 1.0);
  }
  filtered[index] = color;
}
