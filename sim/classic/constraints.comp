#version 460
#extension GL_GOOGLE_include_directive : require
#include "sim/classic/length_constraint.glslh"
#include "sim/turn.glslh"
#include "sim/strand_kernel.glsl"
#include "sim/classic/constraints.glsl"

void main() {
  uint strand = gl_GlobalInvocationID.x;
  if (strand >= strand_count) return;
  uint first = offsets[strand], last = offsets[strand + 1u];
  if (first == last) return;
  uint anchor = anchor_of(first, last);
  for (uint sweep = 0u; sweep < iterations; ++sweep) sweep_lengths(anchor, last);
  if (ends_substep != 0u || !is_reached(strand)) finish(strand, first, last);
}
