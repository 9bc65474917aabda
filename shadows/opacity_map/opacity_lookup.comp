#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, between the two nearest slices.
layout(local_size_x = 64) in;
#include "shadows/map_filter.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 5) writeonly buffer Transmittance { float transmittance[]; };

uint slice_behind, own_nearer, own_farther;  // what the own fibre has left before that slice, and before the next

void own_deposit(uint covered, uint depth_step) {
  const uint amount = table[covered];
  own_nearer += depth_step < slice_behind ? amount : 0u;
  own_farther += depth_step <= slice_behind ? amount : 0u;
}

float exponent_at(uint texel, float z) {
  const float limited = min(z, float(push.layers));
  slice_behind = min(uint(limited), push.layers - 1u);
  own_nearer = own_farther = 0u;
  walk_own();
  const uint first = kept_place(texel) * push.layers;
  const float nearer = slice_behind == 0u ? 0.0 : float(sums[first + slice_behind - 1u] - own_nearer);
  const float farther = float(sums[first + slice_behind] - own_farther);
  return push.per_unit * between_planes(nearer, farther, limited - float(slice_behind));
}

void main() {
  const uint v = invocation();
  if (v >= push.count) return;
  const float through = transmittance_of_vertex(placement_of(least), v, push.intervals);
  if (through >= 0.0) transmittance[v] = through;
}
