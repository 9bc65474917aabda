// One thread per strand, all substeps of a frame of a solver of rigid links: chain_lanes.h without its lanes.
// A solver includes this with k_scratch_rows defined and TOUCHES 0, 1 (spheres) or 2
// (all colliders; fields only where specialised), and defines `substep`. With ON_SKIN every strand has a head of its own,
// and colliders are all as those that move by themselves, in the world.
#ifndef ON_SKIN
#define ON_SKIN 0
#endif
#include "sim/chains/device/chain_storage.glsl"
#include "sim/chains/contact/dissipation.glslh"
#include "sim/chains/device/chain_contact.glsl"
#include "sim/chains/device/chain_follow.glsl"
#include "sim/chains/device/chain_motion.glsl"

// The solver's own.
void substep(uint links, ChainStep s);

void carry_state(uint links) {
  for (uint i = 0u; i <= links; ++i)
    for (uint row = 0u; row < state_row_tension; row += 3u) put_state(i, row, carried_turn(state_vector(i, row)));
}

bool all_finite(uint links) {
  bool good = true;
  for (uint i = 1u; i <= links; ++i)
    for (uint row = 0u; row < state_row_tension; row += 3u) good = good && finite(state_vector(i, row));
  return good;
}

void reset(uint links) {
  vec3 target = vec3(0), along = vec3(0, -1, 0);
  for (uint i = 0u; i <= links; ++i) {
    if (i > 0u) {
      along = direction_or(target_of(i) - target_of(i - 1u), 0, along);
      target += along * rest[rest_at(i, rest_row_length)];  // targets in motion have other lengths
    }
    vec3 velocity = head_velocity(anchor_place() + target);
    put_state(i, state_row_here, head_turn(target));
    put_state(i, state_row_before, head_turn(target));
    put_state(i, state_row_velocity, velocity);
    put_state(i, state_row_velocity_before, velocity);
    state[state_at(i, state_row_tension)] = 0;
  }
  strands[strand_base + strand_row_guarded * k_lanes] = 2;
}

// chains/sleepers.h for one strand.
bool sleeps_on() {
  if (is_woken) strands[strand_base + strand_row_quiet * k_lanes] = 0;
  return strands[strand_base + strand_row_quiet * k_lanes] >= sleep_time;
}

void bring_to_rest(uint links) {
  for (uint i = 1u; i <= links; ++i) {
    put_state(i, state_row_before, state_vector(i, state_row_here));
    put_state(i, state_row_velocity, vec3(0));
    put_state(i, state_row_velocity_before, vec3(0));
  }
}

void fall_asleep(uint links) {
  float fastest = 0;
  for (uint i = 1u; i <= links; ++i)
    fastest = max(fastest, inner(state_vector(i, state_row_velocity), state_vector(i, state_row_velocity)));
  bool rests = fastest < sleep_speed * sleep_speed && strands[strand_base + strand_row_guarded * k_lanes] < 2;
  float quiet = rests ? strands[strand_base + strand_row_quiet * k_lanes] + frame_time : 0;
  strands[strand_base + strand_row_quiet * k_lanes] = quiet;
  if (quiet >= sleep_time) bring_to_rest(links);
}

void show(uint strand, uint anchor) {
  for (uint i = offsets[strand]; i < offsets[strand + 1u]; ++i) {
    uint link = vertices[i].w, fixed_at = min(i, offsets[strand] + anchor);
    bool carried = i < offsets[strand] + anchor || link == 0u;
    world[i] = vec4(carried_place(fixed_at) + (carried ? vec3(0) : state_vector(link, state_row_here)), 1);
    velocities[i] = vec4(carried ? carried_velocity(fixed_at) : state_vector(link, state_row_velocity), 0);
  }
}

void main() {
  uint strand = gl_GlobalInvocationID.x;
  if (strand >= strand_count) return;
  uvec4 place = places[strand];
  resets[strand] = 0u;
  find_reach(strand);
  if (place.w != 0u) {
    uint links = blocks[place.x].x;
    first_vertex = blocks[place.x].y;
    lane = place.y;
    strand_base = place.x * strand_row_count * k_lanes + lane;
#if ON_SKIN
    on_skin = skin_strands[strand];
    is_woken = is_woken || moves_strand();
#endif
    if (k_sleeps && sleeps_on()) return;
#if ON_SKIN
    if (carries != 0u) reset(links);
#else
    if (carries != 0u) carry_state(links);
#endif
    for (part = 0u; part < step_count; ++part) substep(links, step_at(part));
    if (!all_finite(links)) {
      reset(links);
      resets[strand] = 1u;
    }
    if (k_sleeps && !is_woken) fall_asleep(links);
  }
  show(strand, place.z);
}
