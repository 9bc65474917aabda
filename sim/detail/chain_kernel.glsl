// Storage, contact and follow-the-leader of the solvers of rigid links: chain_lanes.h without its lanes, one thread per
// strand, all substeps of a frame. A solver includes this with k_scratch_rows defined and TOUCHES 0, 1 (spheres) or 2
// (all colliders; fields only where specialised), and defines `substep`. With ON_SKIN every strand has a head of its own,
// and colliders are all as those that move by themselves, in the world.
#ifndef ON_SKIN
#define ON_SKIN 0
#endif
#include "sim/detail/box_contact.glslh"
#include "sim/finite.glsl"
#if ON_SKIN
#include "sim/detail/skin_turn.glslh"
#endif
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
#if TOUCHES == 2
layout(constant_id = 1) const bool k_meets_fields = false;
layout(constant_id = 2) const bool k_some_move = false;  // colliders by themselves: ChainFrame::carries
layout(binding = 15) readonly buffer Boxes { LinkBox boxes[]; };
layout(binding = 17) readonly buffer FieldValues { float field_values[]; };  // of one field after the other
#include "sim/detail/moving_contact.glslh"
layout(binding = 16) readonly buffer Fields { LinkField fields[]; };
layout(binding = 18) readonly buffer Carries { ColliderCarry collider_carries[]; };
#else
const bool k_some_move = false;
#endif
#if ON_SKIN
struct SkinStrand {
  vec4 along, across;  // unit, at rest; along.w: whether the strand bends
  uvec4 vertices;      // anchor, farthest, side
};
const int k_skin_binding = TOUCHES == 2 ? 19 : 15;
layout(binding = k_skin_binding) readonly buffer SkinStrands { SkinStrand skin_strands[]; };
layout(binding = k_skin_binding + 1) readonly buffer SkinBegin { vec4 skin_begin[]; };  // where the skin has the vertices
layout(binding = k_skin_binding + 2) readonly buffer SkinEnd { vec4 skin_end[]; };      // at the frame's begin and end
#endif
layout(push_constant) uniform Constants {
  uint strand_count, step_count, sphere_count, box_count, field_count, carries;
  uint still;                                // whether nothing acts that did not in the frame before
  float sleep_speed, sleep_time, frame_time;  // of k_sleeps: m/s, s, s
};
layout(constant_id = 0) const bool k_sleeps = false;

const uint k_lanes = 16u, k_rest_rows = 10u, k_state_rows = 13u, k_strand_rows = 5u;
const uint k_length = 0u, k_inverse_length = 1u, k_mass = 2u, k_inverse_mass = 3u, k_mass_ratio = 4u, k_reach = 5u,
           k_pull = 6u, k_target = 7u;
const uint k_here = 0u, k_before = 3u, k_velocity = 6u, k_velocity_before = 9u, k_tension = 12u;
const uint k_place = 0u, k_direction = 3u, k_weight = 6u, k_coupling = 7u, k_value = 8u, k_follows = 9u, k_normal = 10u,
           k_begin_pushed = 13u, k_touched = k_follows;
const uint k_guarded = 3u, k_quiet = 4u;

uint first_vertex, lane, strand_base, part;  // of the frame's substeps

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

// Where a link was turned, and by which collider that moves by itself (0: none); the zero vector: nowhere.
void take_normal(uint i, vec3 normal, uint number) {
  if (inner(normal, normal) == 0) return;
  put_scratch(i, k_normal, normal);
  if (k_some_move) scratch[scratch_at(i, k_touched)] = float(number);
}

#if TOUCHES == 2
// AnchorWay of collider_lanes.h.
#if ON_SKIN
vec3 anchor_on_skin(uint moment);
vec3 anchor_begin(ChainStep s) { return anchor_on_skin(part); }
vec3 anchor_end(ChainStep s) { return anchor_on_skin(part + 1u); }
#else
vec3 anchor_begin(ChainStep s) { return turned_to_begin(s, anchor_place()); }
vec3 anchor_end(ChainStep s) { return turned_to_end(s, anchor_place()); }
#endif

LinkBox box_at(ChainStep s, uint k) {
  float first_link = rest[rest_at(1u, k_length)];
  if (k_some_move) return moved_box(s, boxes[part * box_count + k], anchor_end(s), first_link);
  return link_box(s, boxes[k], anchor_place(), first_link);
}
LinkField field_at(ChainStep s, uint k, uint values) {
  float first_link = rest[rest_at(1u, k_length)];
  if (k_some_move) return moved_field(s, fields[part * field_count + k], values, anchor_end(s), first_link);
  return link_field(s, fields[k], values, anchor_place(), first_link);
}
// Of a box or field (in this order) that moves by itself.
ColliderCarry carry_at(uint k) { return collider_carries[part * (box_count + field_count) + k]; }
vec3 carried_by(ChainStep s, uint k, vec3 here) {
  return turned_along(carry_at(k), here) + carry_offset(carry_at(k), anchor_begin(s), anchor_end(s));
}
uint value_count(uint k) {
  uvec3 nodes = uvec3(fields[k].cells) + 1u;
  return nodes.x * nodes.y * nodes.z;
}

void push_from_moving_box(ChainStep s, uint k, vec3 here, inout Touch touch) {
  LinkBox box = box_at(s, k);
  vec3 carried = carried_by(s, k, here);
  float way = length(touch.place - carried);
  if (!is_within(sphere_around(box), touch.place, way)) return;
  Surface met = outruns(way, thickness_of(box)) ? met_on_box(box, carried, touch.place) : inside_box(box, touch.place);
  touch = pushed_from(touch, met, inside_box(box, carried), carried, s, float(k + 1u));
}

void push_from_moving_field(ChainStep s, uint k, uint values, vec3 here, inout Touch touch) {
  LinkField field = field_at(s, k, values);
  vec3 carried = carried_by(s, box_count + k, here);
  float way = length(touch.place - carried);
  if (!is_within(sphere_around(field.grid), touch.place, way)) return;
  Surface met = outruns(way, thickness_of(field)) ? met_on_field(field, values, carried, touch.place)
                                                  : inside_field(field, values, touch.place);
  touch = pushed_from(touch, met, inside_field(field, values, carried), carried, s, float(box_count + k + 1u));
}

void push_from_moving(ChainStep s, vec3 here, inout Touch touch) {
  for (uint k = 0u; k < box_count; ++k) push_from_moving_box(s, k, here, touch);
  if (!k_meets_fields) return;
  for (uint k = 0u, values = 0u; k < field_count; values += value_count(k), ++k)
    push_from_moving_field(s, k, values, here, touch);
}

void push_from_boxes(ChainStep s, vec3 carried, inout Touch touch) {
  for (uint k = 0u; k < box_count; ++k) {
    LinkBox box = box_at(s, k);
    LinkSphere around = sphere_around(box);
    if (is_within(around, touch.place, 0.0) || is_within(around, carried, 0.0))
      touch = pushed_from(touch, inside_box(box, touch.place), inside_box(box, carried), carried, s, 0);
  }
}

void push_from_fields(ChainStep s, vec3 carried, inout Touch touch) {
  for (uint k = 0u, values = 0u; k < field_count; values += value_count(k), ++k) {
    LinkField field = field_at(s, k, values);
    LinkSphere around = sphere_around(field.grid);
    if (is_within(around, touch.place, 0.0) || is_within(around, carried, 0.0))
      touch = pushed_from(touch, inside_field(field, values, touch.place), inside_field(field, values, carried),
                          carried, s, 0);
  }
}

vec3 turn_beside_boxes(uint i, ChainStep s, vec3 from, vec3 turned, float rest_length, float kept) {
  for (uint k = 0u; k < box_count; ++k) {
    LinkBox box = box_at(s, k);
    if (!is_within(sphere_around(box), from, rest_length)) continue;
    box.radius -= kept;
    Turned out_of = turned_out_of_box(from, turned, rest_length, box, s.end_x, s.end_y);
    take_normal(i, out_of.normal, k + 1u);
    turned = out_of.direction;
  }
  return turned;
}

vec3 turn_beside_fields(uint i, ChainStep s, vec3 from, vec3 turned, float rest_length, float kept) {
  for (uint k = 0u, values = 0u; k < field_count; values += value_count(k), ++k) {
    LinkField field = field_at(s, k, values);
    if (!is_within(sphere_around(field.grid), from, rest_length)) continue;
    if (!may_enter(field, values, from, turned * rest_length, rest_length)) continue;
    field.grid.radius -= kept;
    Turned out_of = turned_out_of_field(from, turned, rest_length, field, values, s.end_x, s.end_y);
    take_normal(i, out_of.normal, box_count + k + 1u);
    turned = out_of.direction;
  }
  return turned;
}
#endif

#if TOUCHES
void press_on_spheres(ChainStep s, float rest_length, inout PredictedLink link) {
  for (uint k = 0u; k < sphere_count; ++k) {
    LinkSphere sphere = sphere_at(s, k);
    if (!is_within(sphere, link.parent, rest_length)) continue;
    Pressed p = pressed_on_sphere(sphere, link.parent, link.child - link.parent, s.end_y);
    link = pressed_out(link, p, link.parent_carried, link.child_carried, s.friction, 0.0);
  }
}
#endif
#if TOUCHES == 2
// `number`: from 1, of a box or field; here: where the vertices begin.
void press(ChainStep s, Pressed p, uint number, vec3 here_parent, vec3 here, inout PredictedLink link) {
  if (!presses(link, p)) return;
  vec3 parent = link.parent_carried, child = link.child_carried;
  if (k_some_move) {
    parent = carried_by(s, number - 1u, here_parent);
    child = carried_by(s, number - 1u, here);
  }
  link = pressed_out(link, p, parent, child, s.friction, float(number));
}

void press_on_boxes(ChainStep s, vec3 here_parent, vec3 here, float rest_length, inout PredictedLink link) {
  for (uint k = 0u; k < box_count; ++k) {
    LinkBox box = box_at(s, k);
    if (!is_within(sphere_around(box), link.parent, rest_length)) continue;
    press(s, pressed_on_box(box, link.parent, link.child - link.parent), k + 1u, here_parent, here, link);
  }
}

void press_on_fields(ChainStep s, vec3 here_parent, vec3 here, float rest_length, inout PredictedLink link) {
  for (uint k = 0u, values = 0u; k < field_count; values += value_count(k), ++k) {
    LinkField field = field_at(s, k, values);
    vec3 way = link.child - link.parent;
    if (!is_within(sphere_around(field.grid), link.parent, rest_length)) continue;
    if (!may_enter(field, values, link.parent, way, rest_length)) continue;
    press(s, pressed_on_field(field, values, link.parent, way), box_count + k + 1u, here_parent, here, link);
  }
}
#endif

#if TOUCHES
// The predicted link above vertex i, from `parent` to `child`, pressed out of all colliders; normals are kept.
PredictedLink pressed_from_all(uint i, ChainStep s, vec3 parent, vec3 child, float follows, float sharpest) {
  vec3 here_parent = state_vector(i - 1u, k_here), here = state_vector(i, k_here);
  float most = leaving(s), rest_length = rest[rest_at(i, k_length)];
  float kept = max(leaving_of(scratch_vector(i, k_begin_pushed), most).kept,
                   i > 1u ? leaving_of(scratch_vector(i - 1u, k_begin_pushed), most).kept : 0.0);
  float touched = k_some_move ? scratch[scratch_at(i, k_touched)] : 0.0;
  PredictedLink link = PredictedLink(parent, child, carried_by_head(s, here_parent), carried_by_head(s, here),
                                     i > 1u ? scratch_vector(i - 1u, k_normal) : vec3(0), scratch_vector(i, k_normal),
                                     rest[rest_at(i, k_mass_ratio)], follows, kept, touched, sharpest);
  press_on_spheres(s, rest_length, link);
#if TOUCHES == 2
  press_on_boxes(s, here_parent, here, rest_length, link);
  if (k_meets_fields) press_on_fields(s, here_parent, here, rest_length, link);
#endif
  if (i > 1u) put_scratch(i - 1u, k_normal, link.parent_normal);
  put_scratch(i, k_normal, link.child_normal);
  if (k_some_move) scratch[scratch_at(i, k_touched)] = link.touched;
  return link;
}
#endif

// Of collider `number` that moves by itself; 0: of one that the head takes along.
vec3 carried_by_what_touches(ChainStep s, uint i, vec3 here) {
#if TOUCHES == 2
  float touched = k_some_move ? scratch[scratch_at(i, k_touched)] : 0;
  if (touched > 0) return carried_by(s, uint(touched) - 1u, here);
#endif
  return carried_by_head(s, here);
}

void push_out(uint i, ChainStep s) {
  vec3 here = state_vector(i, k_here), carried = carried_by_head(s, here), fallback = direction_or(here, 0, s.end_y);
  Touch touch = Touch(scratch_vector(i, k_place), vec3(0), vec3(0), 0);
  for (uint k = 0u; k < sphere_count; ++k) {
    LinkSphere sphere = sphere_at(s, k);
    touch = pushed_from(touch, inside_sphere(sphere, touch.place, fallback), inside_sphere(sphere, carried, fallback),
                        carried, s, 0);
  }
#if TOUCHES == 2
  if (k_some_move) {
    push_from_moving(s, here, touch);
    scratch[scratch_at(i, k_touched)] = touch.collider;
  } else {
    push_from_boxes(s, carried, touch);
    if (k_meets_fields) push_from_fields(s, carried, touch);
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
  float free_parent, excess, kept;
};

vec3 turn_beside(uint i, ChainStep s, vec3 from, vec3 aimed, float rest_length, float kept) {
  vec3 turned = aimed;
  for (uint k = 0u; k < sphere_count; ++k) {
    LinkSphere met = sphere_at(s, k);
    met.radius -= kept;
    vec3 out_of = turned_out(from, turned, rest_length, met, s.end_x, s.end_y), moved = out_of - turned;
    if (inner(moved, moved) > 0) take_normal(i, normal_of_turned(met, from, out_of, rest_length), 0u);
    turned = out_of;
  }
#if TOUCHES == 2
  turned = turn_beside_boxes(i, s, from, turned, rest_length, kept);
  if (k_meets_fields) turned = turn_beside_fields(i, s, from, turned, rest_length, kept);
#endif
  return turned;
}

void follow_beside(uint i, ChainStep s, StrandStep strand, vec3 newton, vec3 aim, float rest_length,
                   inout Following f) {
  vec3 from = state_vector(i - 1u, k_here);
  Leaving leave = leaving_of(scratch_vector(i, k_begin_pushed), leaving(s));
  vec3 aimed = from + aim * rest_length,
       place = from + turn_beside(i, s, from, aim, rest_length, max(f.kept, leave.kept)) * rest_length,
       turn = place - aimed;
  vec3 pushed = pushed_along(f.pushed, aim);
  vec3 pull = cleanup_pull(aimed - newton - pushed, rest_length, rest[rest_at(i, k_mass_ratio)], strand.inverse_time);
  put_state(i - 1u, k_velocity, state_vector(i - 1u, k_velocity) - pull * f.free_parent);
  Touch touch = Touch(place, scratch_vector(i, k_normal), leave.moved, 0);
  bool touches = inner(touch.normal, touch.normal) > 0;
  vec3 begin = state_vector(i, k_before);
  vec3 beside = touching_velocity(place, begin, carried_by_what_touches(s, i, begin + strand.root_step), touch,
                                  sqrt(inner(turn, turn)), s.friction, s.per_second);
  put_state(i, k_velocity, either(touches, beside, (place - state_vector(i, k_velocity)) * strand.inverse_time));
  put_state(i, k_here, place);
  f.pushed = pushed + turn;
  f.kept = leave.kept;
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

#if ON_SKIN
SkinStrand on_skin;

vec3 skin_place(uint vertex, float share) { return skinned_place(skin_begin[vertex].xyz, skin_end[vertex].xyz, share); }
vec3 skin_velocity(uint vertex) {
  return frame_time > 0 ? (skin_end[vertex].xyz - skin_begin[vertex].xyz) / frame_time : vec3(0);
}
float share_at(uint moment) { return float(moment) / float(max(step_count, 1u)); }
vec3 anchor_on_skin(uint moment) { return skin_place(on_skin.vertices.x, share_at(moment)); }
SkinTurn turn_at(uint part) {
  float share = share_at(part);
  vec3 anchor = skin_place(on_skin.vertices.x, share);
  return skin_turn(on_skin.along.xyz, on_skin.across.xyz, skin_place(on_skin.vertices.y, share) - anchor,
                   skin_place(on_skin.vertices.z, share) - anchor, on_skin.along.w > 0);
}
vec3 turned_by(SkinTurn t, vec3 v) { return t.x * v.x + t.y * v.y + t.z * v.z; }

ChainStep step_at(uint k) {
  ChainStep s = steps[k];
  SkinTurn begin = turn_at(k), end = turn_at(k + 1u);
  s.begin_x = begin.x;
  s.begin_y = begin.y;
  s.begin_z = begin.z;
  s.end_x = end.x;
  s.end_y = end.y;
  s.end_z = end.z;
  s.head_step = (skin_end[on_skin.vertices.x].xyz - skin_begin[on_skin.vertices.x].xyz) / float(step_count);
  return s;
}
vec3 carried_turn(vec3 v) { return v; }
vec3 head_turn(vec3 v) { return turned_by(turn_at(max(step_count, 1u)), v); }
vec3 head_velocity(vec3 v) {
  vec3 turning = vec3(0);
  if (step_count > 0u) turning = (head_turn(v) - turned_by(turn_at(step_count - 1u), v)) * steps[0].per_second;
  return skin_velocity(on_skin.vertices.x) + turning;
}
vec3 carried_place(uint vertex) { return skin_end[vertex].xyz; }
vec3 carried_velocity(uint vertex) { return skin_velocity(vertex); }
#else
ChainStep step_at(uint k) { return steps[k]; }
vec3 turned_by(vec4 x, vec4 y, vec4 z, vec3 v) { return x.xyz * v.x + y.xyz * v.y + z.xyz * v.z; }
vec3 carried_turn(vec3 v) { return turned_by(frame.carry_x, frame.carry_y, frame.carry_z, v); }
vec3 head_turn(vec3 v) { return turned_by(frame.turn_x, frame.turn_y, frame.turn_z, v); }
vec3 head_velocity(vec3 v) {
  return frame.moving.xyz + turned_by(frame.turning_x, frame.turning_y, frame.turning_z, v);
}

vec3 carried_place(uint vertex) { return frame.translation.xyz + head_turn(uintBitsToFloat(vertices[vertex].xyz)); }
vec3 carried_velocity(uint vertex) { return head_velocity(uintBitsToFloat(vertices[vertex].xyz)); }
#endif

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
  vec3 target = vec3(0), along = vec3(0, -1, 0);
  for (uint i = 0u; i <= links; ++i) {
    if (i > 0u) {
      along = direction_or(target_of(i) - target_of(i - 1u), 0, along);
      target += along * rest[rest_at(i, k_length)];  // targets in motion have other lengths
    }
    vec3 velocity = head_velocity(anchor_place() + target);
    put_state(i, k_here, head_turn(target));
    put_state(i, k_before, head_turn(target));
    put_state(i, k_velocity, velocity);
    put_state(i, k_velocity_before, velocity);
    state[state_at(i, k_tension)] = 0;
  }
  strands[strand_base + k_guarded * k_lanes] = 2;
}

// detail/sleepers.h for one strand.
bool sleeps_on() {
  if (still == 0u) strands[strand_base + k_quiet * k_lanes] = 0;
  return strands[strand_base + k_quiet * k_lanes] >= sleep_time;
}

void bring_to_rest(uint links) {
  for (uint i = 1u; i <= links; ++i) {
    put_state(i, k_before, state_vector(i, k_here));
    put_state(i, k_velocity, vec3(0));
    put_state(i, k_velocity_before, vec3(0));
  }
}

void fall_asleep(uint links) {
  float fastest = 0;
  for (uint i = 1u; i <= links; ++i)
    fastest = max(fastest, inner(state_vector(i, k_velocity), state_vector(i, k_velocity)));
  bool rests = fastest < sleep_speed * sleep_speed && strands[strand_base + k_guarded * k_lanes] < 2;
  float quiet = rests ? strands[strand_base + k_quiet * k_lanes] + frame_time : 0;
  strands[strand_base + k_quiet * k_lanes] = quiet;
  if (quiet >= sleep_time) bring_to_rest(links);
}

void show(uint strand, uint anchor) {
  for (uint i = offsets[strand]; i < offsets[strand + 1u]; ++i) {
    uint link = vertices[i].w, fixed_at = min(i, offsets[strand] + anchor);
    bool carried = i < offsets[strand] + anchor || link == 0u;
    world[i] = vec4(carried_place(fixed_at) + (carried ? vec3(0) : state_vector(link, k_here)), 1);
    velocities[i] = vec4(carried ? carried_velocity(fixed_at) : state_vector(link, k_velocity), 0);
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
    if (k_sleeps && sleeps_on()) return;
#if ON_SKIN
    on_skin = skin_strands[strand];
    if (carries != 0u) reset(links);
#else
    if (carries != 0u) carry_state(links);
#endif
    for (part = 0u; part < step_count; ++part) substep(links, step_at(part));
    if (!all_finite(links)) {
      reset(links);
      resets[strand] = 1u;
    }
    if (k_sleeps && still != 0u) fall_asleep(links);
  }
  show(strand, place.z);
}
