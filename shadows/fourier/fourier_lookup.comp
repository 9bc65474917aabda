#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, from each texel's coefficients.
layout(local_size_x = 64) in;
#define UNROLLED [[unroll]]
#include "shadows/fourier/fourier.glslh"
const uint k_max_functions = 2u * k_max_harmonics + 1u;
#include "shadows/series_own.glsl"
#define STRAND_LIST_BINDING 7
#include "strands/lod/strand_list.glsl"

float known_z = -1.0;  // the depth that `basis` is of: one for all texels of a lookup
Integrals basis;

float exponent_at(uint texel, float z) {
  const uint harmonics = (k_functions - 1u) / 2u;
  const float depth = seen_depth(z / float(k_series_steps), harmonics, scattered_power());
  if (!(depth > 0.0) || sum_of(texel, 0u) <= 0) return 0.0;
  read_sums(texel);
  const float whole = float(sums_left[0]);
  if (!(whole > 0.0)) return 0.0;
  if (depth >= 1.0) return exponent_of_share(whole, 1.0);
  for (; z != known_z; known_z = z)  // a loop is skipped where a condition would be masked
    basis = integrals(depth, harmonics, push.own[0]);
  float sum = 0.0;
  [[unroll]] for (uint i = 0u; i < k_functions; ++i) sum += basis.of[i] * float(sums_left[i]);
  const float count = fibres_of(push.per_unit * whole, scattered_fibre);
  return exponent_of_share(whole, seen_share(clamp(sum / whole, 0.0, 1.0), harmonics, count, scattered_power()));
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v < push.count) look_up(v);
}
