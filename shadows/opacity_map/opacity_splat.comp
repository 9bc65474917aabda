#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the intervals between slices by integer sums.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) buffer Sums { uint sums[]; };

void deposit(uint texel, uint covered, uint depth_step) {
  if (depth_step < push.layers && is_kept(texel))
    atomicAdd(sums[kept_place(texel) * push.layers + depth_step], table[covered]);
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
