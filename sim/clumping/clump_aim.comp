#version 460
#extension GL_GOOGLE_include_directive : require
// What every vertex of a clump is pulled to in the frame, from where its guide is. One thread a vertex. With ON_SKIN every
// strand has a head of its own.
#include "gpu/groups.glsl"
#include "sim/clumping/clumping.glslh"
#ifndef ON_SKIN
#define ON_SKIN 0
#endif
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Numbers { vec4 numbers[]; };  // ClumpedVertex: base, share; apart, between
layout(binding = 1) readonly buffer Rows { uvec4 rows[]; };  // above, below, target, bits of most_squared; strand, guide
layout(binding = 2) readonly buffer States { float state[]; };
layout(binding = 3) buffer Rest { float rest[]; };
layout(push_constant) uniform Constants {
  vec4 x, y, z;
  uint vertex_count;
};
const uint k_lanes = 16u;

vec3 place(uint at) { return vec3(state[at], state[at + k_lanes], state[at + 2u * k_lanes]); }
#if ON_SKIN
#include "sim/chains/skin/skin_strand.glsl"
layout(binding = 4) readonly buffer SkinStrands { SkinStrand skin_strands[]; };
layout(binding = 5) readonly buffer SkinBegin { vec4 skin_begin[]; };

vec3 root_of(uint strand) { return skin_begin[skin_strands[strand].vertices.x].xyz; }
SkinTurn turn_of_strand(uint strand) {
  SkinStrand s = skin_strands[strand];
  return turn_of(s, skin_begin[s.vertices.x].xyz, skin_begin[s.vertices.y].xyz, skin_begin[s.vertices.z].xyz);
}
#endif

vec3 aim_of(uint i, vec3 guide) {
  vec4 base = numbers[2u * i];
#if ON_SKIN
  uvec4 strands = rows[2u * i + 1u];
  SkinTurn turn = turn_of_strand(strands.x);
  mat3 to_rest = transpose(mat3(turn.x, turn.y, turn.z));
  return clump_aim(base.xyz - numbers[2u * i + 1u].xyz * base.w, base.w, guide + (root_of(strands.y) - root_of(strands.x)),
                   to_rest[0], to_rest[1], to_rest[2]);
#else
  return clump_aim(base.xyz, base.w, guide, x.xyz, y.xyz, z.xyz);
#endif
}

void main() {
  uint i = invocation();
  if (i >= vertex_count) return;
  uvec4 at = rows[2u * i];
  vec3 guide = guide_place(place(at.x), place(at.y), numbers[2u * i + 1u].w);
  if (!leads(guide, uintBitsToFloat(at.w))) return;
  vec3 aim = aim_of(i, guide);
  if (!is_place(aim)) return;
  for (uint c = 0u; c < 3u; ++c) rest[at.z + c * k_lanes] = aim[c];
}
