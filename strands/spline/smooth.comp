#version 460
#extension GL_GOOGLE_include_directive : require
// N4: one thread per vertex of the smoothed control hairs; the tangents of its segment are computed on the way.
#include "cuticle/strands/spline/bezier.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };       // hairs + 1
layout(std430, binding = 1) readonly buffer Controls { vec4 controls[]; };     // world positions
layout(std430, binding = 2) writeonly buffer Smoothed { vec4 smoothed[]; };    // hairs x vertices
layout(push_constant) uniform Constants { uint hairs; uint vertices; };

vec3 control(uint first, uint count, int i) { return controls[first + uint(clamp(i, 0, int(count) - 1))].xyz; }

vec3 point_at(uint first, uint count, uint vertex) {
  if (count == 1u) return controls[first].xyz;
  const int i = int(curve_segment(vertex, vertices, count));
  const vec3 before = control(first, count, i - 1), begin = control(first, count, i);
  const vec3 end = control(first, count, i + 1), after = control(first, count, i + 2);
  return bezier_point(begin, end, control_tangent(before, begin, end), control_tangent(begin, end, after),
                      curve_place(vertex, vertices, count));
}

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (i >= hairs * vertices) return;
  const uint first = offsets[i / vertices], count = offsets[i / vertices + 1u] - first;
  smoothed[i] = vec4(point_at(first, count, i % vertices), 0.0);
}
