#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, between the two nearest slices.
layout(local_size_x = 64) in;
#include "shadows/map_filter.glsl"

layout(binding = 0) uniform samplerBuffer vertices;
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 3) writeonly buffer Transmittance { float transmittance[]; };

float exponent_at(uint texel, float z) {
  const float limited = min(z, float(push.layers));
  const uint slice = min(uint(limited), push.layers - 1u);
  const uint first = texel * push.layers;
  const float nearer = slice == 0u ? 0.0 : float(sums[first + slice - 1u]);
  return push.per_unit * between_planes(nearer, float(sums[first + slice]), limited - float(slice));
}

void main() {
  const uint v = invocation();
  if (v < push.count) transmittance[v] = transmittance_at(placement_of(least), texelFetch(vertices, int(v)).xyz, push.intervals);
}
