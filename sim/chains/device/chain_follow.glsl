// The way down a strand, lengths exact: the end of chain_lanes.h without its lanes.
// What the way down carries from parent to child.
struct Following {
  vec3 newton, pushed;
  float free_parent, excess, kept;
};

void follow_beside(uint i, ChainStep s, StrandStep strand, vec3 newton, vec3 aim, float rest_length,
                   inout Following f) {
  vec3 from = state_vector(i - 1u, state_row_here);
  Leaving leave = leaving_of(scratch_vector(i, scratch_row_begin_pushed), leaving(s));
  vec3 aimed = from + aim * rest_length,
       place = from + turn_beside(i, s, from, aim, rest_length, max(f.kept, leave.kept)) * rest_length,
       turn = place - aimed;
  vec3 pushed = pushed_along(f.pushed, aim);
  vec3 pull = cleanup_pull(aimed - newton - pushed, rest_length, rest[rest_at(i, rest_row_mass_ratio)], strand.inverse_time);
  put_state(i - 1u, state_row_velocity, state_vector(i - 1u, state_row_velocity) - pull * f.free_parent);
  Touch touch = Touch(place, scratch_vector(i, scratch_row_normal), leave.moved, 0);
  bool touches = inner(touch.normal, touch.normal) > 0;
  vec3 begin = state_vector(i, state_row_before);
  vec3 beside = touching_velocity(place, begin, carried_by_what_touches(s, i, begin + strand.root_step), touch,
                                  sqrt(inner(turn, turn)), s.friction, s.per_second);
  put_state(i, state_row_velocity, either(touches, beside, (place - state_vector(i, state_row_velocity)) * strand.inverse_time));
  put_state(i, state_row_here, place);
  f.pushed = pushed + turn;
  f.kept = leave.kept;
  f.free_parent = touches ? 0 : 1;
  f.excess = touches ? 1 : f.excess;
}

void follow(uint i, StrandStep strand, vec3 newton, vec3 aim, float rest_length) {
  vec3 place = state_vector(i - 1u, state_row_here) + aim * rest_length;
  vec3 pull = cleanup_pull(place - newton, rest_length, rest[rest_at(i, rest_row_mass_ratio)], strand.inverse_time);
  put_state(i - 1u, state_row_velocity, state_vector(i - 1u, state_row_velocity) - pull);
  put_state(i, state_row_velocity, (place - state_vector(i, state_row_velocity)) * strand.inverse_time);
  put_state(i, state_row_here, place);
}

// The Newton step put vertex i at `newton`.
void go_down(uint i, ChainStep s, StrandStep strand, vec3 newton, vec3 fallback, inout Following f) {
  float rest_length = rest[rest_at(i, rest_row_length)];
  f.excess = max(f.excess, excess_of_newton(newton - f.newton, rest_length));
  f.newton = newton;
  vec3 aim = direction_or(newton - state_vector(i - 1u, state_row_here), 1e-3 * rest_length, fallback);
#if TOUCHES
  follow_beside(i, s, strand, newton, aim, rest_length, f);
#else
  follow(i, strand, newton, aim, rest_length);
#endif
}

StrandStep begun(ChainStep s) {
  StrandStep strand = strand_step(s, anchor_place(), strands[strand_base + strand_row_guarded * k_lanes]);
  put_state(0u, state_row_velocity, strand.root_step * s.per_second);
  return strand;
}
void ended(Following f) { strands[strand_base + strand_row_guarded * k_lanes] = f.excess > 0 ? 1 : 0; }
