#version 460
#extension GL_GOOGLE_include_directive : require
#if ON_SKIN
#define PLACES buffer
#endif
#include "sim/classic/length_constraint.glslh"
#include "sim/classic/verlet.glslh"
#include "sim/turn.glslh"
#include "sim/strand_kernel.glsl"

#if ON_SKIN
// H3: every node where the skin carries it, then the free ones simulated.
layout(binding = 10) readonly buffer SkinBegin { vec4 skin_begin[]; };  // at the frame's begin
layout(binding = 11) readonly buffer SkinEnd { vec4 skin_end[]; };

vec3 begin_target(uint i) {
  return skinned_place(skin_begin[i].xyz, skin_end[i].xyz, float(part_index()) / float(part_count()));
}
void move_place(uint i) {
  float share = float(part_index() + 1u) / float(part_count());
  places[i].xyz = skinned_place(skin_begin[i].xyz, skin_end[i].xyz, share);
}
#else
vec3 begin_target(uint i) { return target_of(i, rotation_begin); }
void move_place(uint i) {}
#endif

void integrate(uint i) {
  move_place(i);
  vec3 here = turned(positions[i].xyz, carry.xyz, carry.w);
  vec3 velocity = turned(velocities[i].xyz, carry.xyz, carry.w);
  vec3 next = target_of(i, rotation_end);
  float pull = kept(shape_rate_at(shape_rate, shape_tip, traits[i].y));
  vec3 moved = verlet_position(here, velocity * velocity_to_step, begin_target(i), next, head_step, pull, fall);
  starts[i] = vec4(here, 0);
  velocities[i] = vec4(velocity, 0);
  positions[i] = vec4(traits[i].x > 0 ? moved : next, 0);
}

void main() {
  uint strand = gl_GlobalInvocationID.x;
  if (strand >= strand_count) return;
  if (part_index() == 0u) resets[strand] = 0u;
  for (uint i = offsets[strand]; i < offsets[strand + 1u]; ++i) integrate(i);
}
