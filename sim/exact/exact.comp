#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// exact/kernel.cpp without its lanes. Compiled with PULLS and TOUCHES 0, 1 or 2.
#include "sim/chains/rows.glslh"
const uint k_scratch_rows = scratch_row_count;
#include "sim/chains/device/chain_kernel.glsl"

Displacement displacement(uint i, ChainStep s, StrandStep strand, vec3 from, vec3 inertial) {
#if PULLS
  vec3 target = turned_to_end(s, target_of(i));
  return pulled_displacement(s, strand, inertial, rest[rest_at(i, rest_row_pull)], target - from,
                             target - turned_to_begin(s, target_of(i)) + strand.root_step);
#else
  return free_displacement(s, strand, inertial);
#endif
}
#if TOUCHES
float stored(uint links, ChainStep s, StrandStep strand) { return 0.0; }
#endif

// Tip to root.
void predict(uint i, ChainStep s, StrandStep strand, inout TensionCarry below) {
  ChainVertex v = chain_vertex(i);
  vec3 from = scheme_from(v, strand), inertial = inertial_displacement(v, strand);
  Displacement d = displacement(i, s, strand, from, inertial);
  TensionCarry carry;
  Led place = led(from + d.moved, rest[rest_at(i, rest_row_mass)] * d.inertia,
                  state[state_at(i, state_row_tension)] * (strand.time * strand.time), below, carry);
  below = carry;
  put_state(i, state_row_before, v.here - strand.root_step);
  put_state(i, state_row_velocity_before, v.velocity);
  put_state(i, state_row_velocity, from);  // until the velocity is known
  put_scratch(i, scratch_row_place, place.place);
  scratch[scratch_at(i, scratch_row_follows)] = place.follows;
  scratch[scratch_at(i, scratch_row_inverse_mass)] = rest[rest_at(i, rest_row_inverse_mass)] * reciprocal(d.inertia);
}

// Root to tip.
void lead(uint i, vec3 parent) {
  put_scratch(
      i, scratch_row_place,
      within_reach(scratch_vector(i, scratch_row_place) + parent * scratch[scratch_at(i, scratch_row_follows)], rest[rest_at(i, rest_row_reach)]));
}

#if TOUCHES
void lead_beside(uint i, ChainStep s) {
  vec3 parent = i > 1u ? scratch_vector(i - 1u, scratch_row_place) : vec3(0);
  float follows = scratch[scratch_at(i, scratch_row_follows)];
  lead(i, parent);
  push_out(i, s);
  PredictedLink link = pressed_from_all(i, s, parent, scratch_vector(i, scratch_row_place), follows, -2.0);
  if (i > 1u) put_scratch(i - 1u, scratch_row_place, link.parent);
  put_scratch(i, scratch_row_place, link.child);
}
#endif

void eliminate(uint i, ChainStep s, inout LinkCarry carry) {
  float rest_length = rest[rest_at(i, rest_row_length)];
  vec3 before = (state_vector(i, state_row_here) - state_vector(i - 1u, state_row_here)) * rest[rest_at(i, rest_row_inverse_length)];
  vec3 predicted = scratch_vector(i, scratch_row_place);
  vec3 direction = direction_or(predicted - carry.place, 1e-3 * rest_length, before);
  vec3 place = fold_opened(predicted, carry, direction, rest_length, (i & 1u) != 0u ? s.end_x : s.end_y);
  LinkRow row;
  float weight = scratch[scratch_at(i, scratch_row_inverse_mass)];
#if TOUCHES
  LinkMasses masses = touching_masses(carry, direction, normal_of(i), second_normal_of(i), weight);
#else
  LinkMasses masses = free_masses(carry, direction, weight);
#endif
  carry = eliminated(carry, masses, place, direction, normal_of(i), second_normal_of(i), weight, rest_length, row);
  put_scratch(i, scratch_row_place, place);
  put_scratch(i, scratch_row_direction, direction);
  scratch[scratch_at(i, scratch_row_coupling)] = row.coupling;
  scratch[scratch_at(i, scratch_row_value)] = row.value;
}

vec3 newton_of(uint i) {
  vec3 above = scratch_vector(i, scratch_row_direction) * scratch[scratch_at(i, scratch_row_value)];
  vec3 under = scratch_vector(i + 1u, scratch_row_direction) * scratch[scratch_at(i + 1u, scratch_row_value)];
  vec3 moved = along_surface((above - under) * scratch[scratch_at(i, scratch_row_inverse_mass)], normal_of(i));
  return scratch_vector(i, scratch_row_place) + along_surface(moved, second_normal_of(i));
}

void substep(uint links, ChainStep s) {
  StrandStep strand = begun(s);
  LinkCarry carry = at_anchor();
  TensionCarry below = below_tip();
  for (uint i = links; i >= 1u; --i) predict(i, s, strand, below);
#if TOUCHES
  for (uint i = 1u; i <= links; ++i) lead_beside(i, s);
#endif
  for (uint i = 1u; i <= links; ++i) {
#if !TOUCHES
    lead(i, carry.place);
#endif
    eliminate(i, s, carry);
  }
  for (uint i = links - 1u; i >= 1u; --i)
    scratch[scratch_at(i, scratch_row_value)] = multiplier(
        scratch[scratch_at(i, scratch_row_value)], scratch[scratch_at(i + 1u, scratch_row_coupling)], scratch[scratch_at(i + 1u, scratch_row_value)]);
  Following f = Following(vec3(0), vec3(0), 0, 0, 0);
  for (uint i = 1u; i <= links; ++i) {
    float change = scratch[scratch_at(i, scratch_row_value)];
#if TOUCHES
    change *= tension_share(strand);
#endif
    state[state_at(i, state_row_tension)] = next_tension(state[state_at(i, state_row_tension)], change,
                                                 rest[rest_at(i, rest_row_inverse_length)], strand.inverse_time);
    go_down(i, s, strand, newton_of(i), scratch_vector(i, scratch_row_direction), f);
  }
  ended(links, s, strand, f);
}
