#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per tile: the scene's depth in each pixel and the farthest in the tile, as 1 / distance. A pixel takes
// the farthest of its texels, so that hair in front of an edge is whole; behind one the merge decides texel by texel.
layout(local_size_x = 64) in;
#include "cuticle/gpu/groups.glsl"
#include "cuticle/render/passes/tile_lists/tile_push.glsl"

layout(std430, binding = 0) writeonly buffer SceneDepth { float scene_depth[]; };
layout(std430, binding = 1) writeonly buffer TileDepth { float tile_depth[]; };
layout(binding = 2) uniform sampler2D scene;

float farthest_in_pixel(uvec2 pixel) {
  float farthest = 0.0;
  ivec2 first = ivec2(pixel * push.supersampling);
  for (int y = 0; y < int(push.supersampling); ++y)
    for (int x = 0; x < int(push.supersampling); ++x)
      farthest = max(farthest, texelFetch(scene, first + ivec2(x, y), 0).r);
  return push.supersampling == 0u ? 0.0 : mix(push.inverse_near, push.inverse_far, farthest);
}

void main() {
  uint tile = invocation();
  uvec2 grid = tile_grid();
  if (tile >= grid.x * grid.y) return;
  uvec2 first = uvec2(tile % grid.x, tile / grid.x) * uint(k_tile);
  uvec2 end = min(first + uint(k_tile), push.part);
  float farthest = push.inverse_near;
  for (uint y = first.y; y < end.y; ++y)
    for (uint x = first.x; x < end.x; ++x) {
      float depth = farthest_in_pixel(uvec2(x, y));
      scene_depth[y * push.part.x + x] = depth;
      farthest = min(farthest, depth);
    }
  tile_depth[tile] = farthest;
}
