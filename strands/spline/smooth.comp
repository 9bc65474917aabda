#version 460
#extension GL_GOOGLE_include_directive : require
// N4: one thread per vertex of the smoothed control hairs; the tangents of its segment are computed on the way.
// Beside the position goes the fraction of the control polygon's length, linear within a segment.
#include "cuticle/gpu/groups.glsl"
#include "cuticle/strands/spline/bezier.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };       // hairs + 1
layout(std430, binding = 1) readonly buffer Controls { vec4 controls[]; };     // world positions
layout(std430, binding = 2) writeonly buffer Smoothed { vec4 smoothed[]; };    // hairs x vertices: position, fraction
layout(push_constant) uniform Constants { uint hairs; uint vertices; };

// One walk along the control hair finds the curve's two ends, their neighbours, and the lengths before, in and of all
// segments.
vec4 smoothed_at(uint first, uint count, uint vertex) {
  const uint segment = count > 1u ? curve_segment(vertex, vertices, count) : 0u;
  const float place = count > 1u ? curve_place(vertex, vertices, count) : 0.0;
  vec3 point = controls[first].xyz, before = point, begin = point, end = point, after = point;
  float behind = 0.0, here = 0.0, whole = 0.0;
  for (uint k = 1u; k < count; ++k) {
    const vec3 next = controls[first + k].xyz;
    const float chord = distance(point, next);
    before = k <= segment ? begin : before;
    begin = k <= segment ? next : begin;
    end = k == segment + 1u ? next : end;
    after = k == segment + 1u || k == segment + 2u ? next : after;
    behind += k <= segment ? chord : 0.0;
    here = k == segment + 1u ? chord : here;
    whole += chord;
    point = next;
  }
  const float fraction =
      whole > 0.0 ? min((behind + here * place) / whole, 1.0) : float(vertex) / float(vertices - 1u);
  return vec4(bezier_point(begin, end, control_tangent(before, begin, end), control_tangent(begin, end, after), place),
              fraction);
}

void main() {
  const uint i = invocation();
  if (i >= hairs * vertices) return;
  const uint first = offsets[i / vertices], count = offsets[i / vertices + 1u] - first;
  smoothed[i] = smoothed_at(first, count, i % vertices);
}
