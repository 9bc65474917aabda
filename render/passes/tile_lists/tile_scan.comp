#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup: where each tile's list begins. Every invocation adds up a run of tiles, one of them the runs' sums.
layout(local_size_x_id = 0) in;
#include "render/passes/tile_lists/tile_push.glsl"

layout(std430, binding = 0) buffer Counts { uint counts[]; };  // in: per tile; out: where its next entry goes
layout(std430, binding = 1) writeonly buffer Offsets { uint offsets[]; };  // one more than tiles
layout(std430, binding = 2) buffer Statistics { uint wanted, not_finite; };

layout(constant_id = 0) const uint k_lanes = 256u;
shared uint sums[k_lanes];

void main() {
  uint lane = gl_LocalInvocationID.x, tiles = tile_grid().x * tile_grid().y, run = (tiles + k_lanes - 1u) / k_lanes;
  uint begin = min(lane * run, tiles), end = min(begin + run, tiles), sum = 0u;
  for (uint tile = begin; tile < end; ++tile) sum += counts[tile];
  sums[lane] = sum;
  barrier();
  if (lane == 0u) {
    uint total = 0u;
    for (uint k = 0u; k < k_lanes; ++k) {
      uint own = sums[k];
      sums[k] = total;
      total += own;
    }
    offsets[tiles] = total;
    wanted = total;
  }
  barrier();
  uint next = sums[lane];
  for (uint tile = begin; tile < end; ++tile) {
    uint own = counts[tile];
    offsets[tile] = counts[tile] = next;
    next += own;
  }
}
