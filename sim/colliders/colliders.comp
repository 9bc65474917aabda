#version 460
#extension GL_GOOGLE_include_directive : require
#include "cuticle/sim/classic/length_constraint.glslh"
#include "cuticle/sim/colliders/contact.glslh"
#include "cuticle/sim/turn.glslh"
#include "cuticle/sim/strand_kernel.glsl"

void push_strand(uint sphere, uint anchor, uint last, vec3 fallback) {
  float radius = spheres[sphere].w;
  vec3 end = turned(spheres[sphere].xyz, rotation_end.xyz, rotation_end.w);
  vec3 begin = turned(spheres[sphere].xyz, rotation_begin.xyz, rotation_begin.w);
  float anchor_end = length(positions[anchor].xyz - end), anchor_begin = length(starts[anchor].xyz - begin);
  for (uint i = anchor + 1u; i < last; ++i) {
    float pearl = pearl_of(radius, traits[i].w, pearl_radius, float(contacts >> 31));
    positions[i].xyz = pushed_out(positions[i].xyz, end, contact_radius(radius, pearl, anchor_end, traits[i].z), fallback);
    starts[i].xyz = pushed_out(starts[i].xyz, begin, contact_radius(radius, pearl, anchor_begin, traits[i].z), fallback);
  }
}

void main() {
  uint strand = gl_GlobalInvocationID.x;
  if (strand >= strand_count) return;
  uint first = offsets[strand], last = offsets[strand + 1u];
  if (first == last) return;
  vec3 outward = direction_of(target_of(last - 1u, rotation_end) - target_of(first, rotation_end));
  for (uint sphere = 0u; sphere < (contacts & 0x7fffffffu); ++sphere) push_strand(sphere, anchor_of(first, last), last, outward);
}
