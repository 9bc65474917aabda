// The sums of a series without the receiver's own fibre. The shader that includes this says, as k_max_functions, how many
// sums a texel may have; how many it has is a constant, so that loops over them come out as straight code: software
// Vulkan reads an array's numbers one by one where it does not know which they are.
#include "shadows/fibres.glslh"
#include "shadows/map_filter.glsl"
#include "shadows/series.glslh"

layout(constant_id = 0) const uint k_functions = 1u;
layout(binding = 3) uniform usamplerBuffer table;  // deposits, then k_functions weights a depth step
layout(binding = 4) uniform usamplerBuffer sums;
layout(binding = 5) uniform usamplerBuffer fibre;  // weights, coverages
layout(std430, binding = 6) writeonly buffer Transmittance { float transmittance[]; };

int sums_left[k_max_functions];

void own_deposit(uint covered, uint depth_step) {
  const uint weights = k_coverage_steps + 1u + min(depth_step, k_series_steps - 1u) * k_functions, amount = texelFetch(table, int(covered)).r;
  [[unroll]] for (uint i = 0u; i < k_functions; ++i)
    sums_left[i] -= weighted_amount(amount, uintBitsToFloat(texelFetch(table, int(weights + i)).r));
}

int sum_of(uint texel, uint i) { return int(texelFetch(sums, int(kept_place(texel) * k_functions + i)).r); }

void read_sums(uint texel) {
  [[unroll]] for (uint i = 0u; i < k_functions; ++i) sums_left[i] = sum_of(texel, i);
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
  const uint mean = fibre_coverage(texelFetch(fibre, 0).r, texelFetch(fibre, 1).r);
  const uint amount = (push.flags & k_poisson) != 0u ? 0u : texelFetch(table, int(mean)).r;
  scattered_fibre = push.per_unit * float(amount);
  const float through = transmittance_of_vertex(placement_of(least), v, float(k_series_steps));
  if (through >= 0.0) transmittance[v] = through;
}
