#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per tile: the largest motion that reaches into it from the tiles around.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/passes/motion_blur/shutter.glsl"

layout(std430, binding = 0) readonly buffer Reach { vec2 reach[]; };
layout(std430, binding = 1) writeonly buffer Spread { vec2 spread[]; };

// Whether pixels of tile `there` that move by `way` to either side may cross tile `here`.
bool may_cross(uvec2 here, uvec2 there, vec2 way) {
  const vec2 gap = max(abs(vec2(here) - vec2(there)) - 1.0, 0.0) * float(k_tile);
  return all(lessThanEqual(gap, abs(way)));
}

void main() {
  const uint tile = invocation();
  if (tile >= tiles.x * tiles.y) return;
  const uvec2 here = uvec2(tile % tiles.x, tile / tiles.x);
  const uint ring = uint(largest) / k_tile + 1u;
  const uvec2 first = here - min(here, uvec2(ring)), end = min(here + ring + 1u, tiles);
  vec2 farthest = vec2(0.0);
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x) {
      const vec2 way = reach[y * tiles.x + x];
      if (may_cross(here, uvec2(x, y), way) && dot(way, way) > dot(farthest, farthest)) farthest = way;
    }
  spread[tile] = farthest;
}
