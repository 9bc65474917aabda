// The sums of a series without the receiver's own fibre. The shader that includes this says, as k_max_functions, how many
// sums a texel may have.
#include "shadows/fibres.glslh"
#include "shadows/map_filter.glsl"
#include "shadows/series.glslh"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };  // deposits, then push.layers weights a depth step
layout(std430, binding = 4) readonly buffer Sums { int sums[]; };
layout(std430, binding = 5) readonly buffer Fibre { uint fibre_weights, fibre_coverages; };
layout(std430, binding = 6) writeonly buffer Transmittance { float transmittance[]; };

int sums_left[k_max_functions];

void own_deposit(uint covered, uint depth_step) {
  const uint weights = k_coverage_steps + 1u + min(depth_step, k_series_steps - 1u) * push.layers;
  for (uint i = 0u; i < push.layers; ++i)
    sums_left[i] -= weighted_amount(table[covered], uintBitsToFloat(table[weights + i]));
}

int sum_of(uint texel, uint i) { return sums[kept_place(texel) * push.layers + i]; }

void read_sums(uint texel) {
  for (uint i = 0u; i < push.layers; ++i) sums_left[i] = sum_of(texel, i);
  walk_own();
}

/// What the mean fibre counts, set once a lookup; 0 where sums are proportional to opacity, which take hair as evenly
/// spread.
float scattered_fibre;

/// The exponent of T before which `share` of the sum `whole` lies.
float exponent_of_share(float whole, float share) {
  const float all = push.per_unit * whole;
  return exponent_of_part(all, seen_fibre(fibres_of(all, scattered_fibre), scattered_fibre, lookup_power), share);
}

/// The power of the lookup where fibres lie at random depths; else 1.
float scattered_power() { return (push.flags & k_poisson) != 0u ? 1.0 : lookup_power; }

void look_up(uint v) {
  const uint amount = (push.flags & k_poisson) != 0u ? 0u : table[fibre_coverage(fibre_weights, fibre_coverages)];
  scattered_fibre = push.per_unit * float(amount);
  const float through = transmittance_of_vertex(placement_of(least), v, float(k_series_steps));
  if (through >= 0.0) transmittance[v] = through;
}
