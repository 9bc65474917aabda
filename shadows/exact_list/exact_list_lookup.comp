#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, from the fragments before the vertex.
layout(local_size_x = 64) in;
#include "shadows/map_filter.glsl"

layout(binding = 0) uniform samplerBuffer vertices;
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer First { uint first[]; };
layout(std430, binding = 3) readonly buffer Fragments { uvec2 fragments[]; };
layout(std430, binding = 4) writeonly buffer Transmittance { float transmittance[]; };

float exponent_at(uint texel, float z) {
  const uint begin = min(first[texel], push.layers), step = uint(z);
  uint behind = begin;  // the first fragment that is not before the step
  for (uint count = min(first[texel + 1u], push.layers) - begin; count > 0u;) {
    const uint half_count = count / 2u;
    const bool is_before = fragments[behind + half_count].x < step;
    behind = is_before ? behind + half_count + 1u : behind;
    count = is_before ? count - half_count - 1u : half_count;
  }
  return behind == begin ? 0.0 : push.per_unit * float(fragments[behind - 1u].y);
}

void main() {
  const uint v = invocation();
  if (v < push.count) transmittance[v] = transmittance_at(placement_of(least), texelFetch(vertices, int(v)).xyz, push.intervals + 1.0);
}
