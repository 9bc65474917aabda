// One invocation per tile: 1 / distance of the farthest that the scene shows in it; 0: something is open.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/passes/cull_strands/cull_push.glsl"

layout(std430, binding = 0) writeonly buffer TileDepth { float tile_depth[]; };

/// The greatest depth that is stored in a texel; 1: nothing drawn.
float texel_depth(ivec2 texel);

float farthest_in(uvec2 first, uvec2 end) {
  float farthest = 0.0;
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x) {
      farthest = max(farthest, texel_depth(ivec2(x, y)));
      if (farthest >= 1.0) return 1.0;
    }
  return farthest;
}

void main() {
  const uint tile = invocation();
  const uvec2 grid = tile_grid();
  if (tile >= grid.x * grid.y) return;
  const uvec2 first = uvec2(tile % grid.x, tile / grid.x) * uint(k_tile);
  const float farthest = has_scene == 0u ? 1.0 : farthest_in(first, min(first + uint(k_tile), size));
  tile_depth[tile] = farthest >= 1.0 ? 0.0 : mix(1.0 / near, 1.0 / far, farthest);
}
