#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// rod/kernel.cpp without its lanes. Compiled with TOUCHES 0 or 1.
#include "sim/rod/rows.glslh"
const uint k_scratch_rows = rod_row_count;
#include "sim/chains/device/chain_kernel.glsl"
#include "sim/rod/rod_step.glslh"

#define ROWS uint
#define ROLLED [[dont_unroll]]
#define UNROLLED [[unroll]]
#define FROM_8_DOWN_TO_ABOVE(m, j) UNROLLED for (int m = 8; m >= 1; --m) if (m > j)
#define AT(rows, row) scratch[(rows) + uint(row) * k_lanes]
#define BAND_BEGIN int(rod_row_band)
#define RIGHT_BEGIN int(rod_row_right)
#include "sim/rod/rod_band.glslh"

uint hinge_at(uint i, uint row) { return ((first_vertex + i) * hinge_row_count + row) * k_lanes + lane; }
float hinge(uint i, uint row) { return own[hinge_at(i, row)]; }
vec3 hinge_vector(uint i, uint row) { return vec3(hinge(i, row), hinge(i, row + 1u), hinge(i, row + 2u)); }
float scratch_number(uint i, uint row) { return scratch[scratch_at(i, row)]; }
void put_number(uint i, uint row, float value) { scratch[scratch_at(i, row)] = value; }

layout(constant_id = 3) const bool k_pulls = false;

Displacement displacement(uint i, ChainStep s, StrandStep strand, vec3 from, vec3 drift) {
  if (!k_pulls) return free_displacement(s, strand, drift);
  vec3 target = turned_to_end(s, target_of(i));
  Displacement pulled = pulled_displacement(s, strand, drift, rest[rest_at(i, rest_row_pull)], target - from,
                                            target - turned_to_begin(s, target_of(i)) + strand.root_step);
  put_number(i, rod_row_inertia, pulled.inertia);
  return pulled;
}

#if TOUCHES
vec3 pull_of_links(uint i, float time) {
  vec3 here = state_vector(i, state_row_here);
  return pulled_by_links(state_vector(i - 1u, state_row_here) - here, state_vector(i + 1u, state_row_here) - here,
                         state[state_at(i, state_row_tension)] * (time * time),
                         state[state_at(i + 1u, state_row_tension)] * (time * time), rest[rest_at(i, rest_row_inverse_mass)],
                         0.5 * rest[rest_at(i, rest_row_length)]);
}

void push(uint i, ChainStep s, vec3 predicted) {
  s.friction = 0.0;
  vec3 parent = i > 1u ? scratch_vector(i - 1u, rod_row_predicted) : vec3(0),
       above_pushed = i > 1u ? scratch_vector(i - 1u, scratch_row_normal) : vec3(0);
  put_scratch(i, scratch_row_place, predicted);
  push_out(i, s);
  vec3 touch = scratch_vector(i, scratch_row_place), normal = scratch_vector(i, scratch_row_normal);
  PredictedLink link = pressed_from_all(i, s, parent, touch, 0.0, 0.9);
  vec3 parent_moved = link.parent - parent;
  if (i > 1u) {
    put_scratch(i - 1u, rod_row_pushed, scratch_vector(i - 1u, rod_row_pushed) + parent_moved);
    put_scratch(i - 1u, scratch_row_normal, above_pushed + push_along(parent_moved, link.parent_normal));
  }
  put_scratch(i, rod_row_predicted, link.child);
  put_scratch(i, rod_row_pushed, link.child - predicted);
  put_scratch(i, scratch_row_normal, push_along(touch - predicted, normal) + push_along(link.child - touch, link.child_normal));
}

Grip grip(uint i, ChainStep s, StrandStep strand, float mass) {
  vec3 push = scratch_vector(i, scratch_row_normal), carried = carried_by_what_touches(s, i, state_vector(i, state_row_here)),
       pushed_to = scratch_vector(i, scratch_row_place) + pull_of_links(i, strand.time) + scratch_vector(i, rod_row_pushed);
  put_scratch(i, scratch_row_normal, direction_or(push, 0, vec3(0)));
  return gripped(pushed_to, carried - scratch_vector(i, rod_row_inertial), push,
                 state_vector(i, state_row_velocity_before) * s.duration - (carried - state_vector(i, state_row_before)), mass,
                 s.friction, least_slide(s));
}
#endif

void predict(uint i, uint links, ChainStep s, StrandStep strand) {
  ChainVertex v = chain_vertex(i);
  vec3 from = scheme_from(v, strand), drift = inertial_displacement(v, strand);
  Displacement displaced = displacement(i, s, strand, from, drift);
  vec3 fall = fall_of(s, strand.time);
  if (k_pulls) fall = pulled_fall(fall, s, strand.time, displaced.inertia);
  InertialPrediction c = inertial_prediction(v.here, from, drift, displaced.moved, fall, rest[rest_at(links, rest_row_reach)]);
  float rest_length = rest[rest_at(i, rest_row_length)];
  vec3 before = (v.here - state_vector(i - 1u, state_row_here)) * rest[rest_at(i, rest_row_inverse_length)];
  vec3 direction = direction_or(c.place - scratch_vector(i - 1u, rod_row_inertial_place), 1e-3 * rest_length, before);
  put_scratch(i, rod_row_inertial_place, c.place);
  vec3 place = scratch_vector(i - 1u, rod_row_inertial) + direction * rest_length;
  put_scratch(i, rod_row_inertial, place);
  put_scratch(i, scratch_row_direction, direction);
#if TOUCHES
  push(i, s, v.here + c.moved + pull_of_links(i, strand.time));
#endif
  put_scratch(i, scratch_row_place, (v.here - place) + c.moved);
  put_state(i, state_row_before, v.here - strand.root_step);
  put_state(i, state_row_velocity_before, v.velocity);
  put_state(i, state_row_velocity, from);  // until the velocity is known
}

void bend(uint i) {
  vec3 above = scratch_vector(i - 1u, scratch_row_direction), here = scratch_vector(i, scratch_row_direction),
       director = scratch_vector(i - 1u, rod_row_director);
  Hinge h = hinge_between(above, here, director, hinge(i, hinge_row_bend_x), hinge(i, hinge_row_bend_y),
                          0.5 * (sane_angle(hinge(i - 1u, hinge_row_angle)) + sane_angle(hinge(i, hinge_row_angle))));
  put_scratch(i, rod_row_director, transported(director, above, here));
  put_scratch(i, rod_row_natural, h.natural);
  put_scratch(i, rod_row_natural_spin, h.natural_spin);
  put_number(i, rod_row_across, h.across);
  put_number(i, rod_row_along, h.along);
  put_number(i, rod_row_moment, hinge(i, hinge_row_stiffness) * spin_moment(h));
  put_number(i, rod_row_rounding, hinge(i, hinge_row_stiffness) * spin_stiffness(h));
}

AngleHinge angle_hinge(uint i) {
  float stiffness = hinge(i, hinge_row_twist);
  float turned = sane_angle(hinge(i, hinge_row_angle)) - sane_angle(hinge(i - 1u, hinge_row_angle)) - hinge(i, hinge_row_natural_angle);
  return AngleHinge(stiffness, scratch_number(i, rod_row_moment), scratch_number(i, rod_row_rounding), stiffness * turned);
}

void turn_angles(uint links) {
  for (uint i = 1u; i <= links; ++i) {
    AngleRow parent = AngleRow(scratch_number(i - 1u, rod_row_angle_coupling), scratch_number(i - 1u, rod_row_angle_value));
    AngleRow row = angle_eliminated(angle_hinge(i), angle_hinge(i + 1u), parent);
    put_number(i, rod_row_angle_coupling, row.coupling);
    put_number(i, rod_row_angle_value, row.value);
  }
  for (uint i = links; i >= 1u; --i)
    put_number(i, rod_row_angle_value,
               limited_turn(multiplier(scratch_number(i, rod_row_angle_value), scratch_number(i, rod_row_angle_coupling),
                                       scratch_number(i + 1u, rod_row_angle_value))));
}

void pull(uint i, StrandStep strand) {
  float turn = scratch_number(i, rod_row_angle_value), above = scratch_number(i - 1u, rod_row_angle_value);
  vec3 natural = spun(scratch_vector(i, rod_row_natural), scratch_vector(i, rod_row_natural_spin), 0.5 * (turn + above));
  vec3 here = scratch_vector(i, scratch_row_direction), parent = scratch_vector(i - 1u, scratch_row_direction), chord = here - parent;
  float across = scratch_number(i, rod_row_across), along = scratch_number(i, rod_row_along),
        weight = hinge(i, hinge_row_stiffness) * (strand.time * strand.time);
  float now = sane_angle(hinge(i, hinge_row_angle)) + turn, twist_weight = hinge(i, hinge_row_twist) * (strand.time * strand.time);
  own[hinge_at(i, hinge_row_angle)] = now;
  put_scratch(i, rod_row_spin_pull,
              spin_by(parent, here) * (twist_weight * (now - hinge(i - 1u, hinge_row_angle) - hinge(i, hinge_row_natural_angle))));
  put_scratch(i, rod_row_pull, bending_pull(chord, across, along, natural) * weight);
  put_number(i, rod_row_gain, weight * across * along);
  put_number(i, rod_row_spin, twist_weight * (along * along - 1.0));
}

#if TOUCHES
float stored(uint links, ChainStep s, StrandStep strand) {
  float sum = 0;
  vec3 clamp_direction = scratch_vector(0u, scratch_row_direction), place = vec3(0), carried = vec3(0);
  LinkDirections parent = LinkDirections(clamp_direction, clamp_direction, clamp_direction);
  for (uint i = 1u; i <= links; ++i) {
    vec3 here = state_vector(i, state_row_here), begun = ways_of(i, s, strand).carried;
    float inverse = rest[rest_at(i, rest_row_inverse_length)];
    LinkDirections link =
        LinkDirections(scratch_vector(i, scratch_row_direction), (begun - carried) * inverse, (here - place) * inverse);
    sum += stored_in_hinge(parent, link, scratch_vector(i, rod_row_pull), scratch_vector(i, rod_row_spin_pull),
                           scratch_number(i, rod_row_gain));
    place = here;
    carried = begun;
    parent = link;
  }
  return sum;
}
#endif

HingeRow hinge_row(uint i) {
  return HingeRow(scratch_vector(i, rod_row_pull), scratch_vector(i, rod_row_spin_pull), scratch_number(i, rod_row_gain),
                  scratch_number(i, rod_row_spin), hinge(i, hinge_row_inverse_length));
}

void assemble(uint i, uint end, ChainStep s, StrandStep strand) {
  uint above = i > 1u ? i - 1u : end;  // nothing bends past the ends: rows of the end are zero
  BendRow bends =
      bend_row(hinge_row(i), hinge_row(i + 1u), hinge_row(min(i + 2u, end)), hinge(above, hinge_row_inverse_length));
  float time = strand.time, inertia = k_pulls ? scratch_number(i, rod_row_inertia) : 1.0 + s.drag * time,
        mass = rest[rest_at(i, rest_row_mass)] * inertia;
  float taut = state[state_at(i, state_row_tension)] * (time * time),
        below = state[state_at(i + 1u, state_row_tension)] * (time * time);
  vec3 wanted = scratch_vector(i, scratch_row_place);
  Grip held = Grip(vec3(0), vec3(0), 0);
#if TOUCHES
  held = grip(i, s, strand, mass);
  wanted += scratch_vector(i, rod_row_pushed);
#endif
  put_rows(scratch_at(i, 0u), mass + taut + below + bends.diagonal + held.along, bends.beside - taut, bends.beyond,
           scratch_vector(i, scratch_row_direction), held.normal, wanted * mass + held.force + bends.force);
}

void eliminate_band(uint i) {
  uint own_rows = scratch_at(i, 0u), parent = scratch_at(i - 1u, 0u), grandparent = scratch_at(max(i, 2u) - 2u, 0u);
  ROLLED for (int c = 0; c < 4; ++c) {
    UNROLLED for (int j = 8; j >= 1; --j) eliminate_entry(own_rows, parent, grandparent, c, j);
    eliminate_pivot(own_rows, parent, grandparent, c);
  }
}

/// A strand that was put back begins with its angles at rest too.
void begin_untwisted(uint links) {
  if (strands[strand_base + strand_row_guarded * k_lanes] < 2) return;
  for (uint i = 1u; i <= links; ++i) own[hinge_at(i, hinge_row_angle)] = 0;
}

void substep(uint links, ChainStep s) {
  begin_untwisted(links);
  StrandStep strand = begun(s);
  put_scratch(0u, scratch_row_direction, turned_to_end(s, hinge_vector(0u, clamp_row_direction)));
  put_scratch(0u, rod_row_director, turned_to_end(s, hinge_vector(0u, clamp_row_director)));
  for (uint i = 1u; i <= links; ++i) predict(i, links, s, strand);
  for (uint i = 1u; i <= links; ++i) bend(i);
  turn_angles(links);
  for (uint i = 1u; i <= links; ++i) pull(i, strand);
  for (uint i = 1u; i <= links; ++i) {
    assemble(i, links + 1u, s, strand);
    eliminate_band(i);
  }
  for (uint i = links; i >= 1u; --i)
    ROLLED for (int c = 3; c >= 0; --c)
        substitute_row(scratch_at(i, 0u), scratch_at(i + 1u, 0u), scratch_at(min(i + 2u, links + 1u), 0u), c);
  Following f = Following(vec3(0), vec3(0), 0, 0, 0);
  for (uint i = 1u; i <= links; ++i) {
    float now =
        next_tension(0.0, -scratch_number(i, rod_row_right + 3u), hinge(i, hinge_row_inverse_length), strand.inverse_time);
#if TOUCHES
    now = mix(state[state_at(i, state_row_tension)], now, tension_share(strand));
#endif
    state[state_at(i, state_row_tension)] = now;
    go_down(i, s, strand, scratch_vector(i, rod_row_inertial) + scratch_vector(i, rod_row_right), scratch_vector(i, scratch_row_direction), f);
  }
  ended(links, s, strand, f);
}
