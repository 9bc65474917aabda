#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// rod/kernel.cpp without its lanes. Compiled with TOUCHES 0 or 1.
const uint k_scratch_rows = 88u;
#include "sim/chains/device/chain_kernel.glsl"
#include "sim/rod/rod_step.glslh"

const uint k_hinge_rows = 7u, k_stiffness = 0u, k_twist = 1u, k_bend_x = 2u, k_bend_y = 3u, k_natural_angle = 4u,
           k_hinge_inverse_length = 5u, k_angle = 6u, k_clamp_direction = 0u, k_clamp_director = 3u;
const uint k_coast = 16u, k_coasted = 19u, k_director = 22u, k_natural = 25u, k_natural_spin = 28u, k_across = 31u,
           k_along = 32u, k_moment = 33u, k_rounding = 34u, k_angle_coupling = 35u, k_angle_value = 36u,
           k_predicted = k_natural, k_pull_row = 37u, k_gain = 40u, k_spin = 41u, k_spin_pull = 42u, k_right = 81u,
           k_pushed = 85u;

#define ROWS uint
#define ROLLED [[dont_unroll]]
#define UNROLLED [[unroll]]
#define FROM_8_DOWN_TO_ABOVE(m, j) UNROLLED for (int m = 8; m >= 1; --m) if (m > j)
#define AT(rows, row) scratch[(rows) + uint(row) * k_lanes]
#define BAND_BEGIN 45
#define RIGHT_BEGIN 81
#include "sim/rod/rod_band.glslh"

uint hinge_at(uint i, uint row) { return ((first_vertex + i) * k_hinge_rows + row) * k_lanes + lane; }
float hinge(uint i, uint row) { return own[hinge_at(i, row)]; }
vec3 hinge_vector(uint i, uint row) { return vec3(hinge(i, row), hinge(i, row + 1u), hinge(i, row + 2u)); }
float scratch_number(uint i, uint row) { return scratch[scratch_at(i, row)]; }
void put_number(uint i, uint row, float value) { scratch[scratch_at(i, row)] = value; }

layout(constant_id = 3) const bool k_pulls = false;
const uint k_inertia = 6u;

Displacement displacement(uint i, ChainStep s, StrandStep strand, vec3 from, vec3 drift) {
  if (!k_pulls) return free_displacement(s, strand, drift);
  vec3 target = turned_to_end(s, target_of(i));
  Displacement pulled = pulled_displacement(s, strand, drift, rest[rest_at(i, k_pull)], target - from,
                                            target - turned_to_begin(s, target_of(i)) + strand.root_step);
  put_number(i, k_inertia, pulled.inertia);
  return pulled;
}

#if TOUCHES
vec3 pull_of_links(uint i, float time) {
  vec3 here = state_vector(i, k_here);
  return pulled_by_links(state_vector(i - 1u, k_here) - here, state_vector(i + 1u, k_here) - here,
                         state[state_at(i, k_tension)] * (time * time),
                         state[state_at(i + 1u, k_tension)] * (time * time), rest[rest_at(i, k_inverse_mass)],
                         0.5 * rest[rest_at(i, k_length)]);
}

void push(uint i, ChainStep s, vec3 predicted) {
  s.friction = 0.0;
  vec3 parent = i > 1u ? scratch_vector(i - 1u, k_predicted) : vec3(0),
       above_pushed = i > 1u ? scratch_vector(i - 1u, k_normal) : vec3(0);
  put_scratch(i, k_place, predicted);
  push_out(i, s);
  vec3 touch = scratch_vector(i, k_place), normal = scratch_vector(i, k_normal);
  PredictedLink link = pressed_from_all(i, s, parent, touch, 0.0, 0.9);
  vec3 parent_moved = link.parent - parent;
  if (i > 1u) {
    put_scratch(i - 1u, k_pushed, scratch_vector(i - 1u, k_pushed) + parent_moved);
    put_scratch(i - 1u, k_normal, above_pushed + push_along(parent_moved, link.parent_normal));
  }
  put_scratch(i, k_predicted, link.child);
  put_scratch(i, k_pushed, link.child - predicted);
  put_scratch(i, k_normal, push_along(touch - predicted, normal) + push_along(link.child - touch, link.child_normal));
}

Grip grip(uint i, ChainStep s, StrandStep strand, float mass) {
  vec3 push = scratch_vector(i, k_normal), carried = carried_by_what_touches(s, i, state_vector(i, k_here)),
       pushed_to = scratch_vector(i, k_place) + pull_of_links(i, strand.time) + scratch_vector(i, k_pushed);
  put_scratch(i, k_normal, direction_or(push, 0, vec3(0)));
  return gripped(pushed_to, carried - scratch_vector(i, k_coast), push,
                 state_vector(i, k_velocity_before) * s.duration - (carried - state_vector(i, k_before)), mass,
                 s.friction, least_slide(s));
}
#endif

void coast(uint i, uint links, ChainStep s, StrandStep strand) {
  ChainVertex v = chain_vertex(i);
  vec3 from = scheme_from(v, strand), drift = coasted(v, strand);
  Displacement displaced = displacement(i, s, strand, from, drift);
  vec3 fall = fall_of(s, strand.time);
  if (k_pulls) fall = pulled_fall(fall, s, strand.time, displaced.inertia);
  Coast c = coast_of(v.here, from, drift, displaced.moved, fall, rest[rest_at(links, k_reach)]);
  float rest_length = rest[rest_at(i, k_length)];
  vec3 before = (v.here - state_vector(i - 1u, k_here)) * rest[rest_at(i, k_inverse_length)];
  vec3 direction = direction_or(c.place - scratch_vector(i - 1u, k_coasted), 1e-3 * rest_length, before);
  put_scratch(i, k_coasted, c.place);
  vec3 place = scratch_vector(i - 1u, k_coast) + direction * rest_length;
  put_scratch(i, k_coast, place);
  put_scratch(i, k_direction, direction);
#if TOUCHES
  push(i, s, v.here + c.moved + pull_of_links(i, strand.time));
#endif
  put_scratch(i, k_place, (v.here - place) + c.moved);
  put_state(i, k_before, v.here - strand.root_step);
  put_state(i, k_velocity_before, v.velocity);
  put_state(i, k_velocity, from);  // until the velocity is known
}

void bend(uint i) {
  vec3 above = scratch_vector(i - 1u, k_direction), here = scratch_vector(i, k_direction),
       director = scratch_vector(i - 1u, k_director);
  Hinge h = hinge_between(above, here, director, hinge(i, k_bend_x), hinge(i, k_bend_y),
                          0.5 * (sane_angle(hinge(i - 1u, k_angle)) + sane_angle(hinge(i, k_angle))));
  put_scratch(i, k_director, transported(director, above, here));
  put_scratch(i, k_natural, h.natural);
  put_scratch(i, k_natural_spin, h.natural_spin);
  put_number(i, k_across, h.across);
  put_number(i, k_along, h.along);
  put_number(i, k_moment, hinge(i, k_stiffness) * spin_moment(h));
  put_number(i, k_rounding, hinge(i, k_stiffness) * spin_stiffness(h));
}

AngleHinge angle_hinge(uint i) {
  float stiffness = hinge(i, k_twist);
  float turned = sane_angle(hinge(i, k_angle)) - sane_angle(hinge(i - 1u, k_angle)) - hinge(i, k_natural_angle);
  return AngleHinge(stiffness, scratch_number(i, k_moment), scratch_number(i, k_rounding), stiffness * turned);
}

void turn_angles(uint links) {
  for (uint i = 1u; i <= links; ++i) {
    AngleRow parent = AngleRow(scratch_number(i - 1u, k_angle_coupling), scratch_number(i - 1u, k_angle_value));
    AngleRow row = angle_eliminated(angle_hinge(i), angle_hinge(i + 1u), parent);
    put_number(i, k_angle_coupling, row.coupling);
    put_number(i, k_angle_value, row.value);
  }
  for (uint i = links; i >= 1u; --i)
    put_number(i, k_angle_value,
               limited_turn(multiplier(scratch_number(i, k_angle_value), scratch_number(i, k_angle_coupling),
                                       scratch_number(i + 1u, k_angle_value))));
}

void pull(uint i, StrandStep strand) {
  float turn = scratch_number(i, k_angle_value), above = scratch_number(i - 1u, k_angle_value);
  vec3 natural = spun(scratch_vector(i, k_natural), scratch_vector(i, k_natural_spin), 0.5 * (turn + above));
  vec3 here = scratch_vector(i, k_direction), parent = scratch_vector(i - 1u, k_direction), chord = here - parent;
  float across = scratch_number(i, k_across), along = scratch_number(i, k_along),
        weight = hinge(i, k_stiffness) * (strand.time * strand.time);
  float now = sane_angle(hinge(i, k_angle)) + turn, twist_weight = hinge(i, k_twist) * (strand.time * strand.time);
  own[hinge_at(i, k_angle)] = now;
  put_scratch(i, k_spin_pull,
              spin_by(parent, here) * (twist_weight * (now - hinge(i - 1u, k_angle) - hinge(i, k_natural_angle))));
  put_scratch(i, k_pull_row, bending_pull(chord, across, along, natural) * weight);
  put_number(i, k_gain, weight * across * along);
  put_number(i, k_spin, twist_weight * (along * along - 1.0));
}

HingeRow hinge_row(uint i) {
  return HingeRow(scratch_vector(i, k_pull_row), scratch_vector(i, k_spin_pull), scratch_number(i, k_gain),
                  scratch_number(i, k_spin), hinge(i, k_hinge_inverse_length));
}

void assemble(uint i, uint end, ChainStep s, StrandStep strand) {
  uint above = i > 1u ? i - 1u : end;  // nothing bends past the ends: rows of the end are zero
  BendRow bends =
      bend_row(hinge_row(i), hinge_row(i + 1u), hinge_row(min(i + 2u, end)), hinge(above, k_hinge_inverse_length));
  float time = strand.time, inertia = k_pulls ? scratch_number(i, k_inertia) : 1.0 + s.drag * time,
        mass = rest[rest_at(i, k_mass)] * inertia;
  float taut = state[state_at(i, k_tension)] * (time * time),
        below = state[state_at(i + 1u, k_tension)] * (time * time);
  vec3 wanted = scratch_vector(i, k_place);
  Grip held = Grip(vec3(0), vec3(0), 0);
#if TOUCHES
  held = grip(i, s, strand, mass);
  wanted += scratch_vector(i, k_pushed);
#endif
  put_rows(scratch_at(i, 0u), mass + taut + below + bends.diagonal + held.along, bends.beside - taut, bends.beyond,
           scratch_vector(i, k_direction), held.normal, wanted * mass + held.force + bends.force);
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
  if (strands[strand_base + k_guarded * k_lanes] < 2) return;
  for (uint i = 1u; i <= links; ++i) own[hinge_at(i, k_angle)] = 0;
}

void substep(uint links, ChainStep s) {
  begin_untwisted(links);
  StrandStep strand = begun(s);
  put_scratch(0u, k_direction, turned_to_end(s, hinge_vector(0u, k_clamp_direction)));
  put_scratch(0u, k_director, turned_to_end(s, hinge_vector(0u, k_clamp_director)));
  for (uint i = 1u; i <= links; ++i) coast(i, links, s, strand);
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
        next_tension(0.0, -scratch_number(i, k_right + 3u), hinge(i, k_hinge_inverse_length), strand.inverse_time);
#if TOUCHES
    now = mix(state[state_at(i, k_tension)], now, tension_share(strand));
#endif
    state[state_at(i, k_tension)] = now;
    go_down(i, s, strand, scratch_vector(i, k_coast) + scratch_vector(i, k_right), scratch_vector(i, k_direction), f);
  }
  ended(f);
}
