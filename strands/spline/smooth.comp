#version 460
#extension GL_GOOGLE_include_directive : require
// N4: one thread per vertex of the smoothed control hairs; the tangents of its segment are computed on the way.
// Beside the position goes the fraction of the control polygon's length, linear within a segment.
#include "cuticle/strands/spline/bezier.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };       // hairs + 1
layout(std430, binding = 1) readonly buffer Controls { vec4 controls[]; };     // world positions
layout(std430, binding = 2) writeonly buffer Smoothed { vec4 smoothed[]; };    // hairs x vertices: position, fraction
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

float fraction_at(uint first, uint count, uint vertex) {
  const uint segment = count > 1u ? curve_segment(vertex, vertices, count) : 0u;
  float before = 0.0, here = 0.0, whole = 0.0;
  for (uint k = 0u; k + 1u < count; ++k) {
    const float chord = distance(controls[first + k].xyz, controls[first + k + 1u].xyz);
    if (k < segment) before += chord;
    if (k == segment) here = chord;
    whole += chord;
  }
  if (whole <= 0.0) return float(vertex) / float(vertices - 1u);
  return min((before + here * curve_place(vertex, vertices, count)) / whole, 1.0);
}

void main() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  const uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (i >= hairs * vertices) return;
  const uint first = offsets[i / vertices], count = offsets[i / vertices + 1u] - first;
  smoothed[i] = vec4(point_at(first, count, i % vertices), fraction_at(first, count, i % vertices));
}
