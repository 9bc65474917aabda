#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// One invocation per segment: deposits, weighted by functions of depth, by integer sums, and the sums of the mean
// fibre.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"
#include "shadows/series.glslh"

layout(constant_id = 0) const uint k_functions = 1u;  // of depth
layout(binding = 3) uniform usamplerBuffer table;     // deposits, then k_functions weights a depth step
layout(std430, binding = 4) buffer Sums { uint sums[]; };
layout(std430, binding = 5) buffer Fibre { uint fibre_weights, fibre_coverages; };
#include "shadows/map_fibre.glsl"

void deposit(uint texel, uint covered, uint depth_step) {
  const uint amount = texelFetch(table, int(covered)).r;
  if (amount == 0u || !is_kept(texel)) return;
  const uint weights = k_coverage_steps + 1u + min(depth_step, k_series_steps - 1u) * k_functions;
  [[unroll]] for (uint i = 0u; i < k_functions; ++i)
    atomicAdd(sums[kept_place(texel) * k_functions + i],
              uint(weighted_amount(amount, uintBitsToFloat(texelFetch(table, int(weights + i)).r))));
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  count_fibre(s);
  walk_segment(s, push.pieces_per_step);
}
