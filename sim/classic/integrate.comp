#version 460
#extension GL_GOOGLE_include_directive : require
#include "cuticle/sim/classic/length_constraint.glslh"
#include "cuticle/sim/classic/verlet.glslh"
#include "cuticle/sim/turn.glslh"
#include "cuticle/sim/strand_kernel.glsl"

void integrate(uint i) {
  vec3 here = turned(positions[i].xyz, carry.xyz, carry.w);
  vec3 velocity = turned(velocities[i].xyz, carry.xyz, carry.w);
  vec3 next = target_of(i, rotation_end);
  float pull = kept(shape_rate_at(shape_rate, shape_tip, traits[i].y));
  vec3 moved = verlet_position(here, velocity * velocity_to_step, target_of(i, rotation_begin), next, head_step, pull, fall);
  starts[i] = vec4(here, 0);
  velocities[i] = vec4(velocity, 0);
  positions[i] = vec4(traits[i].x > 0 ? moved : next, 0);
}

void main() {
  uint strand = gl_GlobalInvocationID.x;
  if (strand >= strand_count) return;
  if (begins_frame != 0u) resets[strand] = 0u;
  for (uint i = offsets[strand]; i < offsets[strand + 1u]; ++i) integrate(i);
}
