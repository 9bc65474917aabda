// What the head, or the skin at the strand's root, does in a frame and in its substeps.
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
  return turn_of(on_skin, skin_place(on_skin.vertices.x, share), skin_place(on_skin.vertices.y, share),
                 skin_place(on_skin.vertices.z, share));
}
bool skin_moves(uint vertex) { return skin_begin[vertex].xyz != skin_end[vertex].xyz; }
// Whether it carries the strand anywhere else in the frame.
bool moves_strand() {
  return skin_moves(on_skin.vertices.x) || skin_moves(on_skin.vertices.y) || skin_moves(on_skin.vertices.z);
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
