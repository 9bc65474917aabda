#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per tile: the largest disc that reaches into it from the tiles around.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/passes/depth_of_field/lens.glsl"

layout(std430, binding = 0) readonly buffer Reach { float reach[]; };
layout(std430, binding = 1) writeonly buffer Spread { float spread[]; };

// Between the nearest pixels of two tiles.
float gap(uvec2 a, uvec2 b) {
  const vec2 apart = max(abs(vec2(a) - vec2(b)) - 1.0, 0.0) * float(k_tile);
  return length(apart);
}

void main() {
  const uint tile = invocation();
  if (tile >= tiles.x * tiles.y) return;
  const uvec2 here = uvec2(tile % tiles.x, tile / tiles.x);
  const uint ring = uint(largest) / k_tile + 1u;
  const uvec2 first = here - min(here, uvec2(ring)), end = min(here + ring + 1u, tiles);
  float widest = k_point;
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x) {
      const float radius = reach[y * tiles.x + x];
      if (radius >= gap(here, uvec2(x, y))) widest = max(widest, radius);
    }
  spread[tile] = widest;
}
