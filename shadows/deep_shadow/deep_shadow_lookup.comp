#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of the visibility, or of its logarithm, between knots.
layout(local_size_x = 64) in;
#include "shadows/map_filter.glsl"

layout(binding = 0) uniform samplerBuffer vertices;
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer First { uint first[]; };
layout(std430, binding = 3) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 4) readonly buffer Knots { uint knots[]; };
layout(std430, binding = 5) writeonly buffer Transmittance { float transmittance[]; };

float depth_of(uint knot) { return float(knots[knot] >> 16); }
float visibility_of(uint knot) { return float(knots[knot] & 0xffffu) / 65535.0; }

float visibility_at(uint texel, float z) {
  const uint begin = 2u * min(first[texel], push.layers), end = begin + counts[texel];
  uint behind = begin;  // the first knot behind the depth
  for (uint count = counts[texel]; count > 0u;) {
    const uint half_count = count / 2u;
    const bool is_before = depth_of(behind + half_count) <= z;
    behind = is_before ? behind + half_count + 1u : behind;
    count = is_before ? count - half_count - 1u : half_count;
  }
  if (behind == begin) return 1.0;
  const float before = visibility_of(behind - 1u);
  if (behind == end) return before;
  const float nearer = depth_of(behind - 1u);
  return between_planes(before, visibility_of(behind), (z - nearer) / (depth_of(behind) - nearer));
}

float exponent_at(uint texel, float z) { return log(max(7.62939453125e-6, visibility_at(texel, z))); }

void main() {
  const uint v = invocation();
  if (v < push.count) transmittance[v] = transmittance_at(placement_of(least), texelFetch(vertices, int(v)).xyz, push.intervals + 1.0);
}
