#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, from the fragments before the vertex.
layout(local_size_x = 64) in;
#include "shadows/map_filter.glsl"
#define STRAND_LIST_BINDING 7
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer First { uint first[]; };
layout(std430, binding = 5) readonly buffer Fragments { uvec2 fragments[]; };
layout(std430, binding = 6) writeonly buffer Transmittance { float transmittance[]; };

uint own_step, own_before;  // what the own fibre has left before that step

void own_deposit(uint covered, uint depth_step) { own_before += depth_step < own_step ? table[covered] : 0u; }

float exponent_at(uint texel, float z) {
  const uint begin = min(first[texel], push.layers), step = uint(z);
  uint behind = begin;  // the first fragment that is not before the step
  for (uint count = min(first[texel + 1u], push.layers) - begin; count > 0u;) {
    const uint half_count = count / 2u;
    const bool is_before = fragments[behind + half_count].x < step;
    behind = is_before ? behind + half_count + 1u : behind;
    count = is_before ? count - half_count - 1u : half_count;
  }
  if (behind == begin) return 0.0;
  own_step = step;
  own_before = 0u;
  walk_own();
  return push.per_unit * float(fragments[behind - 1u].y - min(fragments[behind - 1u].y, own_before));
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v >= push.count) return;
  const float found = transmittance_of_vertex(placement_of(least), v, push.intervals + 1.0);
  if (found >= 0.0) transmittance[v] = found;
}
