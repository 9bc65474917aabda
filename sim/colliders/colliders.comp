#version 460
#extension GL_GOOGLE_include_directive : require
#include "sim/classic/length_constraint.glslh"
#include "sim/colliders/contact.glslh"
#include "sim/turn.glslh"
#include "sim/strand_kernel.glsl"
#include "sim/classic/constraints.glsl"

vec3 push(vec3 place, uint i, uint sphere, vec4 rotation, vec3 anchor, vec3 fallback) {
  float radius = spheres[sphere].w;
  vec3 centre = turned(spheres[sphere].xyz, rotation.xyz, rotation.w);
  float pearl = pearl_of(radius, traits[i].w, pearl_radius, float(contacts >> 31));
  return pushed_out(place, centre, contact_radius(radius, pearl, length(anchor - centre), traits[i].z), fallback);
}

bool touches(vec3 place, uint i, uint sphere, vec4 rotation, vec3 anchor) {
  float radius = spheres[sphere].w;
  vec3 centre = turned(spheres[sphere].xyz, rotation.xyz, rotation.w);
  float pearl = pearl_of(radius, traits[i].w, pearl_radius, float(contacts >> 31));
  return is_pushed(place, centre, contact_radius(radius, pearl, length(anchor - centre), traits[i].z));
}

// Whether any vertex is in a sphere when the substep begins, or where the constraints have put it.
bool meets(uint begin, uint end, uint sphere_count, uint anchor, uint last) {
  for (uint sphere = 0u; sphere < sphere_count; ++sphere)
    for (uint i = anchor + 1u; i < last; ++i)
      if (touches(starts[i].xyz, i, begin + sphere, rotation_begin, starts[anchor].xyz) ||
          touches(positions[i].xyz, i, end + sphere, rotation_end, positions[anchor].xyz))
        return true;
  return false;
}

void push_starts(uint sphere, uint anchor, uint last, vec3 fallback) {
  for (uint i = anchor + 1u; i < last; ++i)
    starts[i].xyz = push(starts[i].xyz, i, sphere, rotation_begin, starts[anchor].xyz, fallback);
}
void push_positions(uint sphere, uint anchor, uint last, vec3 fallback) {
  for (uint i = anchor + 1u; i < last; ++i)
    positions[i].xyz = push(positions[i].xyz, i, sphere, rotation_end, positions[anchor].xyz, fallback);
}

// Of the strands that a sphere may touch, of which ends_substep says how many; the others have ended their substep.
void main() {
  if (gl_GlobalInvocationID.x >= ends_substep) return;
  uint strand = reached_strand(gl_GlobalInvocationID.x);
  uint first = offsets[strand], last = offsets[strand + 1u], sphere_count = contacts & 0x3fffffffu;
  if (first == last) return;
  uint anchor = anchor_of(first, last);
  bool move = (contacts & 0x40000000u) != 0u;
  uint begin = move ? 2u * part_index() * sphere_count : 0u, end = move ? begin + sphere_count : 0u;
  if (!meets(begin, end, sphere_count, anchor, last)) {
    finish(strand, first, last);
    return;
  }
  vec3 outward = direction_of(target_of(last - 1u, rotation_end) - target_of(first, rotation_end));
  for (uint sphere = 0u; sphere < sphere_count; ++sphere) push_starts(begin + sphere, anchor, last, outward);
  for (uint sweep = 0u; sweep < iterations; ++sweep) {
    sweep_lengths(anchor, last);
    for (uint sphere = 0u; sphere < sphere_count; ++sphere) push_positions(end + sphere, anchor, last, outward);
  }
  finish(strand, first, last);
}
