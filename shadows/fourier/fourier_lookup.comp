#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, from each texel's coefficients.
layout(local_size_x = 64) in;
#include "shadows/fourier/fourier.glslh"
#include "shadows/map_filter.glsl"
#include "shadows/series.glslh"

layout(binding = 0) uniform samplerBuffer vertices;
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer Sums { int sums[]; };
layout(std430, binding = 3) writeonly buffer Transmittance { float transmittance[]; };

float known_z = -1.0;  // the depth that `basis` is of: one for all texels of a lookup
Integrals basis;

float exponent_at(uint texel, float z) {
  const uint first = texel * push.layers;
  const float whole = float(sums[first]), depth = z / float(k_series_steps);
  if (!(depth > 0.0) || !(whole > 0.0)) return 0.0;
  if (depth >= 1.0) return push.per_unit * whole;
  if (z != known_z) basis = integrals(depth, (push.layers - 1u) / 2u, push.own[0]);
  known_z = z;
  float sum = 0.0;
  for (uint i = 0u; i < push.layers; ++i) sum += basis.of[i] * float(sums[first + i]);
  return push.per_unit * clamp(sum, 0.0, whole);
}

void main() {
  const uint v = invocation();
  if (v < push.count)
    transmittance[v] = transmittance_at(placement_of(least), texelFetch(vertices, int(v)).xyz, float(k_series_steps));
}
