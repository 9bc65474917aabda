#version 460
#extension GL_GOOGLE_include_directive : require
#define STRAND_THREADS 32
#define POSITIONS coherent buffer
#include "sim/classic/length_constraint.glslh"
#include "sim/turn.glslh"
#include "sim/strand_kernel.glsl"
#include "sim/classic/constraints.glsl"

// A work group per strand, a thread per segment of one colour: the sums are those of sweep_lengths.
void wait_for_all() {
  memoryBarrierBuffer();
  barrier();
}

void sweep_at_once(uint anchor, uint last) {
  uint thread = gl_LocalInvocationID.x;
  for (uint i = anchor + 1u + thread; long_range != 0u && i < last; i += STRAND_THREADS) keep_reach(i, anchor);
  wait_for_all();
  for (uint colour = 1u; colour <= 2u; ++colour) {
    for (uint i = anchor + colour + 2u * thread; i < last; i += 2u * STRAND_THREADS) keep_length(i);
    wait_for_all();
  }
  for (uint i = anchor + 1u + thread; has_spheres() && i < last; i += STRAND_THREADS) keep_in_sphere(i);
  wait_for_all();
}

void main() {
  for (uint strand = gl_WorkGroupID.x; strand < strand_count; strand += gl_NumWorkGroups.x) {
    uint first = offsets[strand], last = offsets[strand + 1u];
    if (first == last) continue;
    uint anchor = anchor_of(first, last);
    for (uint sweep = 0u; sweep < iterations; ++sweep) sweep_at_once(anchor, last);
    const bool ends = ends_substep != 0u || !is_reached(strand);
    if (ends && gl_LocalInvocationID.x == 0u) finish(strand, first, last);
  }
}
