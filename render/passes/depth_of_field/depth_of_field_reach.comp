#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per tile: the largest disc of its pixels that can lie before others; the background cannot.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/passes/depth_of_field/lens.glsl"

layout(std430, binding = 0) readonly buffer PixelDepth { float pixel_depth[]; };
layout(std430, binding = 1) writeonly buffer Reach { float reach[]; };

void main() {
  const uint tile = invocation();
  if (tile >= tiles.x * tiles.y) return;
  const uvec2 first = uvec2(tile % tiles.x, tile / tiles.x) * k_tile, end = min(first + k_tile, resolution);
  float widest = k_point;
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x) {
      const float inverse = pixel_depth[y * resolution.x + x];
      widest = max(widest, inverse > 0.0 ? blur_radius(inverse) : k_point);
    }
  reach[tile] = widest;
}
