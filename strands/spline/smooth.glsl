// N4: the curve through a control hair. Before this: `vec3 control_at(uint k)`, and what bezier.glslh declares.

// Position, and the fraction of the control polygon's length, linear within a segment. One walk along the control hair
// finds the curve's two ends, their neighbours, and the lengths before, in and of all segments.
vec4 smoothed_at(uint first, uint count, uint vertex, uint vertices) {
  const uint segment = count > 1u ? curve_segment(vertex, vertices, count) : 0u;
  const float place = count > 1u ? curve_place(vertex, vertices, count) : 0.0;
  vec3 point = control_at(first), before = point, begin = point, end = point, after = point;
  float behind = 0.0, here = 0.0, whole = 0.0;
  for (uint k = 1u; k < count; ++k) {
    const vec3 next = control_at(first + k);
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
