#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, from each texel's moments.
layout(local_size_x = 64) in;
#include "shadows/map_filter.glsl"
#include "shadows/moments/moments.glslh"
#include "shadows/series.glslh"

layout(binding = 0) uniform samplerBuffer vertices;
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer Sums { int sums[]; };
layout(std430, binding = 3) writeonly buffer Transmittance { float transmittance[]; };

const uint k_trigonometric = 2u;  // k_trigonometric_flag of moments_gpu.cpp

float moment(uint texel, uint i) { return float(sums[texel * push.layers + i]) / float(sums[texel * push.layers]); }

float share_before(uint texel, float depth) {
  const float bias = push.own[0], overestimation = push.own[1];
  if ((push.flags & k_trigonometric) != 0u)
    return circle_share(vec2(moment(texel, 1u), moment(texel, 2u)), vec2(moment(texel, 3u), moment(texel, 4u)), bias,
                        depth, overestimation);
  PowerMoments moments;
  for (uint i = 0u; i < 7u; ++i) moments.b[i] = i < push.layers ? moment(texel, i) : 0.0;
  return power_share(biased(moments, bias), 2.0 * depth - 1.0, overestimation, int(push.layers + 1u) / 2);
}

float exponent_at(uint texel, float z) {
  const float whole = float(sums[texel * push.layers]), depth = z / float(k_series_steps);
  if (!(depth > 0.0) || !(whole > 0.0)) return 0.0;
  return push.per_unit * (depth >= 1.0 ? whole : whole * share_before(texel, depth));
}

void main() {
  const uint v = invocation();
  if (v < push.count)
    transmittance[v] = transmittance_at(placement_of(least), texelFetch(vertices, int(v)).xyz, float(k_series_steps));
}
