// Colliders: contact_lanes.h and collider_lanes.h without their lanes.
LinkSphere sphere_at(ChainStep s, uint k) {
  return link_sphere(s, spheres[k].centre, spheres[k].radius, anchor_place(), rest[rest_at(1u, rest_row_length)]);
}

// Where a link was turned, and by which collider that moves by itself (0: none); the zero vector: nowhere.
void take_normal(uint i, vec3 normal, uint number) {
  if (inner(normal, normal) == 0) return;
  put_scratch(i, scratch_row_normal, normal);
  if (k_some_move) scratch[scratch_at(i, scratch_row_touched)] = float(number);
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
  float first_link = rest[rest_at(1u, rest_row_length)];
  if (k_some_move) return moved_box(s, boxes[part * box_count + k], anchor_end(s), first_link);
  return link_box(s, boxes[k], anchor_place(), first_link);
}
LinkField field_at(ChainStep s, uint k, uint values) {
  float first_link = rest[rest_at(1u, rest_row_length)];
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
  if (!presses(link, p) && !lies_over_edge(link, p)) return;
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
  vec3 here_parent = state_vector(i - 1u, state_row_here), here = state_vector(i, state_row_here);
  float most = leaving(s), rest_length = rest[rest_at(i, rest_row_length)];
  float kept = max(leaving_of(scratch_vector(i, scratch_row_begin_pushed), most).kept,
                   i > 1u ? leaving_of(scratch_vector(i - 1u, scratch_row_begin_pushed), most).kept : 0.0);
  float touched = k_some_move ? scratch[scratch_at(i, scratch_row_touched)] : 0.0;
  PredictedLink link = PredictedLink(parent, child, carried_by_head(s, here_parent), carried_by_head(s, here),
                                     i > 1u ? scratch_vector(i - 1u, scratch_row_normal) : vec3(0), scratch_vector(i, scratch_row_normal),
                                     i > 1u ? scratch_vector(i - 1u, scratch_row_second_normal) : vec3(0), vec3(0),
                                     rest[rest_at(i, rest_row_mass_ratio)], follows, kept, touched, sharpest,
                                     i > 1u ? scratch[scratch_at(i - 1u, scratch_row_edge)] : 0.0, 0.0);
  press_on_spheres(s, rest_length, link);
#if TOUCHES == 2
  press_on_boxes(s, here_parent, here, rest_length, link);
  if (k_meets_fields) press_on_fields(s, here_parent, here, rest_length, link);
#endif
  if (i > 1u) {
    put_scratch(i - 1u, scratch_row_normal, link.parent_normal);
    put_scratch(i - 1u, scratch_row_second_normal, link.parent_second);
  }
  put_scratch(i, scratch_row_normal, link.child_normal);
  put_scratch(i, scratch_row_second_normal, link.child_second);
  scratch[scratch_at(i, scratch_row_edge)] = link.edge;
  if (k_some_move) scratch[scratch_at(i, scratch_row_touched)] = link.touched;
  return link;
}
#endif

// Of collider `number` that moves by itself; 0: of one that the head takes along.
vec3 carried_by_what_touches(ChainStep s, uint i, vec3 here) {
#if TOUCHES == 2
  float touched = k_some_move ? scratch[scratch_at(i, scratch_row_touched)] : 0;
  if (touched > 0) return carried_by(s, uint(touched) - 1u, here);
#endif
  return carried_by_head(s, here);
}

void push_out(uint i, ChainStep s) {
  vec3 here = state_vector(i, state_row_here), carried = carried_by_head(s, here), fallback = direction_or(here, 0, s.end_y);
  Touch touch = Touch(scratch_vector(i, scratch_row_place), vec3(0), vec3(0), 0);
  for (uint k = 0u; k < sphere_count; ++k) {
    LinkSphere sphere = sphere_at(s, k);
    touch = pushed_from(touch, inside_sphere(sphere, touch.place, fallback), inside_sphere(sphere, carried, fallback),
                        carried, s, 0);
  }
#if TOUCHES == 2
  if (k_some_move) {
    push_from_moving(s, here, touch);
    scratch[scratch_at(i, scratch_row_touched)] = touch.collider;
  } else {
    push_from_boxes(s, carried, touch);
    if (k_meets_fields) push_from_fields(s, carried, touch);
  }
#endif
  put_scratch(i, scratch_row_place, touch.place);
  put_scratch(i, scratch_row_normal, touch.normal);
  put_scratch(i, scratch_row_begin_pushed, touch.begin_pushed);
}

vec3 normal_of(uint i) {
#if TOUCHES
  return scratch_vector(i, scratch_row_normal);
#else
  return vec3(0);
#endif
}
vec3 second_normal_of(uint i) {
#if TOUCHES
  return scratch_vector(i, scratch_row_second_normal);
#else
  return vec3(0);
#endif
}

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
