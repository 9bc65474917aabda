#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of the visibility, or of its logarithm, between knots.
layout(local_size_x = 64) in;
#include "shadows/deep_shadow/own_steps.glslh"
#include "shadows/map_filter.glsl"
#define STRAND_LIST_BINDING 8
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer First { uint first[]; };
layout(std430, binding = 5) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 6) readonly buffer Knots { uint knots[]; };
layout(std430, binding = 7) writeonly buffer Transmittance { float transmittance[]; };

float depth_of(uint knot) { return float(knots[knot] >> 16); }
float visibility_of(uint knot) { return float(knots[knot] & 0xffffu) / 65535.0; }

float visibility_at(uint texel, float z) {
  const uint begin = 2u * min(first[texel], push.layers), end = begin + counts[texel];
  uint behind = begin;  // the first knot behind the depth
  for (uint count = counts[texel]; count > 0u;) {
    const uint half_count = count / 2u;
    const bool is_before = depth_of(behind + half_count) <= z;
    behind = is_before ? behind + half_count + 1u : behind;
    count = is_before ? count - half_count - 1u : half_count;
  }
  if (behind == begin) return 1.0;
  const float before = visibility_of(behind - 1u);
  if (behind == end) return before;
  const float nearer = depth_of(behind - 1u);
  return between_planes(before, visibility_of(behind), (z - nearer) / (depth_of(behind) - nearer));
}

OwnSteps own_steps;
float lookup_z;

void own_deposit(uint covered, uint depth_step) {
  if (table[covered] > 0u) own_steps = with_own_step(own_steps, float(depth_step), lookup_z);
}

float exponent_at(uint texel, float z) {
  float visibility = visibility_at(texel, z);
  own_steps = no_own_steps(z);
  lookup_z = z;
  walk_own();
  if (own_steps.first < z)
    visibility = without_own(visibility_at(texel, own_steps.first), visibility_at(texel, own_steps.end), visibility,
                             max(k_least_bound, push.own[0]));
  return log(max(7.62939453125e-6, visibility));
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v >= push.count) return;
  const float found = transmittance_of_vertex(placement_of(least), v, push.intervals + 1.0);
  if (found >= 0.0) transmittance[v] = found;
}
