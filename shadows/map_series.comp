#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits, weighted by functions of depth, by integer sums, and the sums of the mean
// fibre.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"
#include "shadows/series.glslh"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };  // deposits, then push.layers weights a depth step
layout(std430, binding = 4) buffer Sums { uint sums[]; };
layout(std430, binding = 5) buffer Fibre { uint fibre_weights, fibre_coverages; };
#include "shadows/map_fibre.glsl"

void deposit(uint texel, uint covered, uint depth_step) {
  const uint amount = table[covered];
  if (amount == 0u || !is_kept(texel)) return;
  const uint weights = k_coverage_steps + 1u + min(depth_step, k_series_steps - 1u) * push.layers;
  for (uint i = 0u; i < push.layers; ++i)
    atomicAdd(sums[kept_place(texel) * push.layers + i],
              uint(weighted_amount(amount, uintBitsToFloat(table[weights + i]))));
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  count_fibre(s);
  walk_segment(s, push.pieces_per_step);
}
