#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, between the two nearest slices.
layout(local_size_x = 64) in;
#include "shadows/fibres.glslh"
#include "shadows/map_filter.glsl"
#include "shadows/opacity_map/ends.glsl"
#define STRAND_LIST_BINDING 7
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 5) readonly buffer Fibre { uint fibre_weights, fibre_coverages; };
layout(std430, binding = 6) writeonly buffer Transmittance { float transmittance[]; };

const uint k_scattered = 4u;  // k_scattered_flag of opacity_map_gpu.cpp: fibres between slices lie at random depths
float fibre_exponent;
uint slice_behind, own_nearer, own_farther;  // what the own fibre has left before that slice, and before the next

void own_deposit(uint covered, uint depth_step) {
  const uint amount = table[covered];
  own_nearer += depth_step < slice_behind ? amount : 0u;
  own_farther += depth_step <= slice_behind ? amount : 0u;
}

float exponent_before(uint texel, float z) {
  const float limited = min(z, float(push.layers));
  slice_behind = min(uint(limited), push.layers - 1u);
  own_nearer = own_farther = 0u;
  walk_own();
  const uint first = kept_place(texel) * push.layers;
  const uint nearer = slice_behind == 0u ? 0u : sums[first + slice_behind - 1u] - own_nearer;
  const uint farther = sums[first + slice_behind] - own_farther;
  const float share = limited - float(slice_behind);
  if ((push.flags & k_scattered) == 0u) return push.per_unit * between_planes(float(nearer), float(farther), share);
  const float before = push.per_unit * float(nearer), between = push.per_unit * float(farther - min(nearer, farther));
  const float exponent = exponent_of_part(between, fibre_exponent, share);
  return before + seen_exponent(fibres_of(between, fibre_exponent), exponent, before, lookup_power);
}

float exponent_at(uint texel, float z) {
  if (!is_between_ends) return exponent_before(texel, z);
  return mix(exponent_before(texel, depths_of_ends[0]), exponent_before(texel, depths_of_ends[1]), share_of_last);
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v >= push.count) return;
  fibre_exponent = push.per_unit * float(table[fibre_coverage(fibre_weights, fibre_coverages)]);
  const MapPlacement placement = placement_of(least);
  find_ends(placement, v);
  const float through = transmittance_of_vertex(placement, v, push.intervals);
  if (through >= 0.0) transmittance[v] = through;
}
