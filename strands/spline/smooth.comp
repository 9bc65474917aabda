#version 460
#extension GL_GOOGLE_include_directive : require
// N4: one thread per vertex of the smoothed control hairs; the tangents of its segment are computed on the way.
#include "gpu/groups.glsl"
#include "strands/spline/bezier.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };       // hairs + 1
layout(binding = 1) uniform samplerBuffer controls;                            // world positions
layout(std430, binding = 2) writeonly buffer Smoothed { vec4 smoothed[]; };    // hairs x vertices: position, fraction
layout(push_constant) uniform Constants { uint hairs; uint vertices; };

vec3 control_at(uint k) { return texelFetch(controls, int(k)).xyz; }
#include "strands/spline/smooth.glsl"

void main() {
  const uint i = invocation();
  if (i >= hairs * vertices) return;
  const uint first = offsets[i / vertices], count = offsets[i / vertices + 1u] - first;
  smoothed[i] = smoothed_at(first, count, i % vertices, vertices);
}
