#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, from each texel's moments.
layout(local_size_x = 64) in;
#include "shadows/moments/moments.glslh"
const uint k_max_functions = 7u;
#include "shadows/series_own.glsl"
#define STRAND_LIST_BINDING 7
#include "strands/lod/strand_list.glsl"

layout(constant_id = 1) const uint k_trigonometric = 0u;  // 1: of the unit circle

float moment(uint i) { return float(sums_left[i]) / float(sums_left[0]); }

float share_before(float depth) {
  const float bias = stored_bias(push.own[0], float(sums_left[0])),
              overestimation = seen_overestimation(push.own[1], scattered_power());
  if (k_trigonometric != 0u)
    return circle_share(vec2(moment(1u), moment(2u)), vec2(moment(3u), moment(4u)), bias, depth, overestimation);
  PowerMoments moments;
  for (uint i = 0u; i < 7u; ++i) moments.b[i] = i < k_functions ? moment(i) : 0.0;
  return power_share(biased(moments, bias), 2.0 * depth - 1.0, overestimation, int(k_functions + 1u) / 2);
}

float exponent_at(uint texel, float z) {
  const float depth = z / float(k_series_steps);
  if (!(depth > 0.0) || sum_of(texel, 0u) <= 0) return 0.0;
  read_sums(texel);
  const float whole = float(sums_left[0]);
  if (!(whole > 0.0)) return 0.0;
  return exponent_of_share(whole, depth >= 1.0 ? 1.0 : share_before(depth));
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v < push.count) look_up(v);
}
