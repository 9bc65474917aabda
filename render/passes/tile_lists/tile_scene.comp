#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per tile: the scene's depth in each pixel and the farthest in the tile, as 1 / distance. A pixel takes
// the farthest of its texels, so that hair in front of an edge is whole; behind one the merge decides texel by texel.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/passes/tile_lists/tile_push.glsl"

layout(std430, binding = 0) writeonly buffer SceneDepth { float scene_depth[]; };
layout(std430, binding = 1) writeonly buffer TileDepth { float tile_depth[]; };
layout(binding = 2) uniform sampler2D scene;

float farthest_in_pixel(uvec2 pixel) {
  float farthest = 0.0;
  int side = int(push.supersampling);
  ivec2 first = ivec2(pixel) * side, at = ivec2(0);
  do {  // a loop that asks before its first turn runs its body once more on lavapipe, masked
    if (side > 0) farthest = max(farthest, texelFetch(scene, first + at, 0).r);
    at = at.x + 1 < side ? ivec2(at.x + 1, at.y) : ivec2(0, at.y + 1);
  } while (at.y < side);
  return push.supersampling == 0u ? 0.0 : mix(push.inverse_near, push.inverse_far, farthest);
}

void main() {
  uint tile = invocation();
  uvec2 grid = tile_grid();
  if (tile >= grid.x * grid.y) return;
  uvec2 first = uvec2(tile % grid.x, tile / grid.x) * uint(k_tile);
  uvec2 end = min(first + uint(k_tile), push.part);
  float farthest = push.inverse_near;
  uvec2 at = first;
  do {
    float depth = farthest_in_pixel(at);
    scene_depth[at.y * push.part.x + at.x] = depth;
    farthest = min(farthest, depth);
    at = at.x + 1u < end.x ? uvec2(at.x + 1u, at.y) : uvec2(first.x, at.y + 1u);
  } while (at.y < end.y);
  tile_depth[tile] = farthest;
}
