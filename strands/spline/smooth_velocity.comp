#version 460
#extension GL_GOOGLE_include_directive : require
// How the vertices of the smoothed control hairs move: the curve through control vertices a moment later less that a
// moment earlier.
#include "gpu/groups.glsl"
#include "strands/spline/bezier.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };    // hairs + 1
layout(binding = 1) uniform samplerBuffer controls;                         // world positions
layout(binding = 2) uniform samplerBuffer motion;                           // velocities, or positions before
layout(std430, binding = 3) writeonly buffer Smoothed { vec4 smoothed[]; };  // hairs x vertices: velocity
layout(push_constant) uniform Constants { uint hairs; uint vertices; float since; };

const float k_moment = 1e-3;  // seconds: hair moves a small part of a segment, and many rounding errors
float moment;                 // along the velocities; with positions before: 0 now, else then

vec3 control_at(uint k) {
  const vec3 now = texelFetch(controls, int(k)).xyz, moves = texelFetch(motion, int(k)).xyz;
  if (since > 0.0) return moment == 0.0 ? now : moves;
  return now + moment * moves;
}
#include "strands/spline/smooth.glsl"

void main() {
  const uint i = invocation();
  if (i >= hairs * vertices) return;
  const uint first = offsets[i / vertices], count = offsets[i / vertices + 1u] - first;
  moment = since > 0.0 ? 0.0 : k_moment;
  const vec3 later = smoothed_at(first, count, i % vertices, vertices).xyz;
  moment = -k_moment;
  const vec3 earlier = smoothed_at(first, count, i % vertices, vertices).xyz;
  smoothed[i] = vec4((later - earlier) / (since > 0.0 ? since : 2.0 * k_moment), 0.0);
}
