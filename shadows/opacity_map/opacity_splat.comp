#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the intervals between slices by integer sums, and the sums of the mean fibre.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) buffer Sums { uint sums[]; };
layout(std430, binding = 5) buffer Fibre { uint fibre_weights, fibre_coverages; };
#include "shadows/map_fibre.glsl"

void deposit(uint texel, uint covered, uint depth_step) {
  if (depth_step < push.layers && is_kept(texel))
    atomicAdd(sums[kept_place(texel) * push.layers + depth_step], table[covered]);
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  count_fibre(s);
  walk_segment(s, push.pieces_per_step);
}
