// Storage, contact and follow-the-leader of the solvers of rigid links: chain_lanes.h without its lanes, one thread per
// strand, all substeps of a frame. A solver includes this with k_scratch_rows defined and TOUCHES 0, 1 (spheres) or 2
// (and boxes), and defines `substep`.
#include "cuticle/sim/detail/box_contact.glslh"
#include "cuticle/sim/finite.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) readonly buffer Places {
  uvec4 places[];
};  // per strand: block, lane, anchor, whether it has links
layout(binding = 1) readonly buffer Blocks { uvec4 blocks[]; };  // links, first vertex
layout(binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(binding = 3) readonly buffer Vertices { uvec4 vertices[]; };  // bits of the rest place; the vertex of the chain
layout(binding = 4) readonly buffer Rest { float rest[]; };          // rows of chain_rows.h
layout(binding = 5) buffer States { float state[]; };
layout(binding = 6) buffer Strands { float strands[]; };
layout(binding = 7) buffer Scratch { float scratch[]; };
layout(binding = 8) readonly buffer Steps { ChainStep steps[]; };
layout(binding = 9) readonly buffer Spheres { LinkSphere spheres[]; };
struct FramePlace {
  vec4 carry_x, carry_y, carry_z, turn_x, turn_y, turn_z, turning_x, turning_y, turning_z, translation, moving;
};
layout(binding = 10) readonly buffer Frame { FramePlace frame; };
layout(binding = 11) writeonly buffer World { vec4 world[]; };
layout(binding = 12) writeonly buffer Velocities { vec4 velocities[]; };
layout(binding = 13) writeonly buffer Resets { uint resets[]; };
layout(binding = 14) buffer Own { float own[]; };  // rows that the solver adds to a vertex
layout(binding = 15) readonly buffer Boxes { LinkBox boxes[]; };
layout(push_constant) uniform Constants { uint strand_count, step_count, sphere_count, box_count, carries; };

const uint k_lanes = 16u, k_rest_rows = 10u, k_state_rows = 13u, k_strand_rows = 4u;
const uint k_length = 0u, k_inverse_length = 1u, k_mass = 2u, k_inverse_mass = 3u, k_mass_ratio = 4u, k_reach = 5u,
           k_pull = 6u, k_target = 7u;
const uint k_here = 0u, k_before = 3u, k_velocity = 6u, k_velocity_before = 9u, k_tension = 12u;
const uint k_place = 0u, k_direction = 3u, k_weight = 6u, k_coupling = 7u, k_value = 8u, k_follows = 9u, k_normal = 10u,
           k_begin_pushed = 13u;
const uint k_guarded = 3u;

uint first_vertex, lane, strand_base;

uint rest_at(uint i, uint row) { return ((first_vertex + i) * k_rest_rows + row) * k_lanes + lane; }
uint state_at(uint i, uint row) { return ((first_vertex + i) * k_state_rows + row) * k_lanes + lane; }
uint scratch_at(uint i, uint row) { return ((first_vertex + i) * k_scratch_rows + row) * k_lanes + lane; }
#define VECTOR_AT(rows, at) vec3(rows[at], rows[(at) + k_lanes], rows[(at) + 2u * k_lanes])
#define PUT_VECTOR(rows, at, v) \
  rows[at] = (v).x;             \
  rows[(at) + k_lanes] = (v).y; \
  rows[(at) + 2u * k_lanes] = (v).z
vec3 state_vector(uint i, uint row) { return VECTOR_AT(state, state_at(i, row)); }
void put_state(uint i, uint row, vec3 v) { PUT_VECTOR(state, state_at(i, row), v); }
vec3 scratch_vector(uint i, uint row) { return VECTOR_AT(scratch, scratch_at(i, row)); }
void put_scratch(uint i, uint row, vec3 v) { PUT_VECTOR(scratch, scratch_at(i, row), v); }
vec3 target_of(uint i) { return VECTOR_AT(rest, rest_at(i, k_target)); }
vec3 anchor_place() { return VECTOR_AT(strands, strand_base); }
ChainVertex chain_vertex(uint i) {
  return ChainVertex(state_vector(i, k_here), state_vector(i, k_before), state_vector(i, k_velocity),
                     state_vector(i, k_velocity_before));
}

LinkSphere sphere_at(ChainStep s, uint k) {
  return link_sphere(s, spheres[k].centre, spheres[k].radius, anchor_place(), rest[rest_at(1u, k_length)]);
}

LinkBox box_at(ChainStep s, uint k) { return link_box(s, boxes[k], anchor_place(), rest[rest_at(1u, k_length)]); }

void push_out(uint i, ChainStep s) {
  vec3 here = state_vector(i, k_here), carried = carried_by_head(s, here), fallback = direction_or(here, 0, s.end_y);
  Touch touch = Touch(scratch_vector(i, k_place), vec3(0), vec3(0));
  for (uint k = 0u; k < sphere_count; ++k) {
    LinkSphere sphere = sphere_at(s, k);
    touch = pushed_from(touch, inside_sphere(sphere, touch.place, fallback), inside_sphere(sphere, carried, fallback),
                        carried, s.friction);
  }
#if TOUCHES == 2
  for (uint k = 0u; k < box_count; ++k) {
    LinkBox box = box_at(s, k);
    LinkSphere around = sphere_around(box);
    if (is_within(around, touch.place, 0.0) || is_within(around, carried, 0.0))
      touch = pushed_from(touch, inside_box(box, touch.place), inside_box(box, carried), carried, s.friction);
  }
#endif
  put_scratch(i, k_place, touch.place);
  put_scratch(i, k_normal, touch.normal);
  put_scratch(i, k_begin_pushed, touch.begin_pushed);
}

vec3 normal_of(uint i) {
#if TOUCHES
  return scratch_vector(i, k_normal);
#else
  return vec3(0);
#endif
}

// What the way down carries from parent to child.
struct Following {
  vec3 newton, pushed;
  float free_parent, excess;
};

vec3 turn_beside(uint i, ChainStep s, vec3 from, vec3 aimed, float rest_length) {
  vec3 turned = aimed;
  for (uint k = 0u; k < sphere_count; ++k) {
    LinkSphere met = sphere_at(s, k);
    vec3 out_of = turned_out(from, turned, rest_length, met, s.end_x, s.end_y), moved = out_of - turned;
    if (inner(moved, moved) > 0)
      put_scratch(i, k_normal, direction_or(from + out_of * rest_length - met.centre, 0, out_of));
    turned = out_of;
  }
#if TOUCHES == 2
  for (uint k = 0u; k < box_count; ++k) {
    LinkBox box = box_at(s, k);
    if (!is_within(sphere_around(box), from, rest_length)) continue;
    Turned out_of = turned_out_of_box(from, turned, rest_length, box, s.end_x, s.end_y);
    if (inner(out_of.normal, out_of.normal) > 0) put_scratch(i, k_normal, out_of.normal);
    turned = out_of.direction;
  }
#endif
  return turned;
}

void follow_beside(uint i, ChainStep s, StrandStep strand, vec3 newton, vec3 aim, float rest_length,
                   inout Following f) {
  vec3 from = state_vector(i - 1u, k_here);
  vec3 aimed = from + aim * rest_length, place = from + turn_beside(i, s, from, aim, rest_length) * rest_length,
       turn = place - aimed;
  vec3 pushed = pushed_along(f.pushed, aim);
  vec3 pull = cleanup_pull(aimed - newton - pushed, rest_length, rest[rest_at(i, k_mass_ratio)], strand.inverse_time);
  put_state(i - 1u, k_velocity, state_vector(i - 1u, k_velocity) - pull * f.free_parent);
  Touch touch = Touch(place, scratch_vector(i, k_normal), scratch_vector(i, k_begin_pushed));
  bool touches = inner(touch.normal, touch.normal) > 0;
  vec3 begin = state_vector(i, k_before);
  vec3 beside = touching_velocity(place, begin, carried_by_head(s, begin + strand.root_step), touch,
                                  sqrt(inner(turn, turn)), s.friction, s.per_second);
  put_state(i, k_velocity, either(touches, beside, (place - state_vector(i, k_velocity)) * strand.inverse_time));
  put_state(i, k_here, place);
  f.pushed = pushed + turn;
  f.free_parent = touches ? 0 : 1;
  f.excess = touches ? 1 : f.excess;
}

void follow(uint i, StrandStep strand, vec3 newton, vec3 aim, float rest_length) {
  vec3 place = state_vector(i - 1u, k_here) + aim * rest_length;
  vec3 pull = cleanup_pull(place - newton, rest_length, rest[rest_at(i, k_mass_ratio)], strand.inverse_time);
  put_state(i - 1u, k_velocity, state_vector(i - 1u, k_velocity) - pull);
  put_state(i, k_velocity, (place - state_vector(i, k_velocity)) * strand.inverse_time);
  put_state(i, k_here, place);
}

// The Newton step put vertex i at `newton`.
void go_down(uint i, ChainStep s, StrandStep strand, vec3 newton, vec3 fallback, inout Following f) {
  float rest_length = rest[rest_at(i, k_length)];
  f.excess = max(f.excess, excess_of_newton(newton - f.newton, rest_length));
  f.newton = newton;
  vec3 aim = direction_or(newton - state_vector(i - 1u, k_here), 1e-3 * rest_length, fallback);
#if TOUCHES
  follow_beside(i, s, strand, newton, aim, rest_length, f);
#else
  follow(i, strand, newton, aim, rest_length);
#endif
}

StrandStep begun(ChainStep s) {
  StrandStep strand = strand_step(s, anchor_place(), strands[strand_base + k_guarded * k_lanes]);
  put_state(0u, k_velocity, strand.root_step * s.per_second);
  return strand;
}
void ended(Following f) { strands[strand_base + k_guarded * k_lanes] = f.excess > 0 ? 1 : 0; }

// The solver's own.
void substep(uint links, ChainStep s);

vec3 turned_by(vec4 x, vec4 y, vec4 z, vec3 v) { return x.xyz * v.x + y.xyz * v.y + z.xyz * v.z; }
vec3 carried_turn(vec3 v) { return turned_by(frame.carry_x, frame.carry_y, frame.carry_z, v); }
vec3 head_turn(vec3 v) { return turned_by(frame.turn_x, frame.turn_y, frame.turn_z, v); }
vec3 head_velocity(vec3 v) {
  return frame.moving.xyz + turned_by(frame.turning_x, frame.turning_y, frame.turning_z, v);
}

void carry_state(uint links) {
  for (uint i = 0u; i <= links; ++i)
    for (uint row = 0u; row < k_tension; row += 3u) put_state(i, row, carried_turn(state_vector(i, row)));
}

bool all_finite(uint links) {
  bool good = true;
  for (uint i = 1u; i <= links; ++i)
    for (uint row = 0u; row < k_tension; row += 3u) good = good && finite(state_vector(i, row));
  return good;
}

void reset(uint links) {
  for (uint i = 0u; i <= links; ++i) {
    vec3 velocity = head_velocity(anchor_place() + target_of(i));
    put_state(i, k_here, head_turn(target_of(i)));
    put_state(i, k_before, head_turn(target_of(i)));
    put_state(i, k_velocity, velocity);
    put_state(i, k_velocity_before, velocity);
    state[state_at(i, k_tension)] = 0;
  }
  strands[strand_base + k_guarded * k_lanes] = 2;
}

void show(uint strand, uint anchor) {
  for (uint i = offsets[strand]; i < offsets[strand + 1u]; ++i) {
    uint link = vertices[i].w, fixed_at = min(i, offsets[strand] + anchor);
    bool carried = i < offsets[strand] + anchor || link == 0u;
    vec3 root = uintBitsToFloat(vertices[fixed_at].xyz);
    world[i] = vec4(frame.translation.xyz + head_turn(root) + (carried ? vec3(0) : state_vector(link, k_here)), 1);
    velocities[i] = vec4(carried ? head_velocity(root) : state_vector(link, k_velocity), 0);
  }
}

void main() {
  uint strand = gl_GlobalInvocationID.x;
  if (strand >= strand_count) return;
  uvec4 place = places[strand];
  resets[strand] = 0u;
  if (place.w != 0u) {
    uint links = blocks[place.x].x;
    first_vertex = blocks[place.x].y;
    lane = place.y;
    strand_base = place.x * k_strand_rows * k_lanes + lane;
    if (carries != 0u) carry_state(links);
    for (uint k = 0u; k < step_count; ++k) substep(links, steps[k]);
    if (!all_finite(links)) {
      reset(links);
      resets[strand] = 1u;
    }
  }
  show(strand, place.z);
}
