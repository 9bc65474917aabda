#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per tile: the largest motion of its pixels.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/passes/motion_blur/shutter.glsl"

layout(std430, binding = 0) readonly buffer Vectors { vec2 vectors[]; };
layout(std430, binding = 1) writeonly buffer Reach { vec2 reach[]; };

void main() {
  const uint tile = invocation();
  if (tile >= tiles.x * tiles.y) return;
  const uvec2 first = uvec2(tile % tiles.x, tile / tiles.x) * k_tile, end = min(first + k_tile, resolution);
  vec2 farthest = vec2(0.0);
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x) {
      const vec2 way = half_way(vectors[y * resolution.x + x]);
      if (dot(way, way) > dot(farthest, farthest)) farthest = way;
    }
  reach[tile] = farthest;
}
