#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: its pieces add to the cells of their middles by integer sums.
layout(local_size_x = 64) in;
#include "shadows/map_segment.glsl"
#include "shadows/voxel/segment_deposit.glsl"

layout(std430, binding = 4) buffer Sums { uint sums[]; };

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  const VolumePlacement placement = volume_placement(lower_of(least), upper_of(least), push.resolution);
  const SegmentDeposit deposit = segment_deposit(placement, s);
  for (uint i = 0u; i < deposit.lanes * deposit.pieces; ++i)
    atomicAdd(sums[cell_number(placement, deposit_place(placement, deposit, i))], deposit.amount);
}
