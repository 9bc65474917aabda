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
#if TOUCHES
// The solver's own: what forces move vertex i, and what bending and twist store.
Displacement displacement(uint i, ChainStep s, StrandStep strand, vec3 from, vec3 drift);
float stored(uint links, ChainStep s, StrandStep strand);

// As ways_of and dissipate of chain_lanes.h.
struct Ways {
  vec3 begin, carried, surface, way;
};
Ways ways_of(uint i, ChainStep s, StrandStep strand) {
  vec3 begin = state_vector(i, state_row_before), carried = carried_by_head(s, begin + strand.root_step),
       left = leaving_of(scratch_vector(i, scratch_row_begin_pushed), leaving(s)).moved;
  return Ways(begin, carried, carried - begin, state_vector(i, state_row_here) - carried - left);
}

void dissipate(uint links, ChainStep s, StrandStep strand) {
  StrandStep euler = first_order(s, strand);
  Work work = no_work();
  for (uint i = 1u; i <= links; ++i) {
    Ways ways = ways_of(i, s, strand);
    vec3 before = state_vector(i, state_row_velocity_before);
    Displacement free = displacement(i, s, euler, ways.begin, before * s.duration);
    work = with_vertex(work, rest[rest_at(i, rest_row_mass)] * free.inertia, ways.way, free.moved - ways.surface,
                       state_vector(i, state_row_velocity) * s.duration - ways.surface, before * s.duration - ways.surface,
                       s.duration);
  }
  float kept = kept_by_contact(work, stored(links, s, strand));
  if (kept >= 1.0) return;
  for (uint i = 1u; i <= links; ++i) {
    vec3 surface = ways_of(i, s, strand).surface * s.per_second;
    put_state(i, state_row_velocity, surface + (state_vector(i, state_row_velocity) - surface) * kept);
  }
}
#endif

void ended(uint links, ChainStep s, StrandStep strand, Following f) {
#if TOUCHES
  float edges = 0;
  for (uint i = 1u; i <= links; ++i) edges += scratch[scratch_at(i, scratch_row_edge)];
  if (!k_some_move && edges > 0) dissipate(links, s, strand);
#endif
  strands[strand_base + strand_row_guarded * k_lanes] = f.excess > 0 ? 1 : 0;
}
