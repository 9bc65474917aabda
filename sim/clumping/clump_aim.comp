#version 460
#extension GL_GOOGLE_include_directive : require
// What every vertex of a clump is pulled to in the frame, from where its guide is. One thread a vertex.
#include "gpu/groups.glsl"
#include "sim/clumping/clumping.glslh"
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Numbers { vec4 numbers[]; };  // ClumpedVertex: base, share; between, most_squared
layout(binding = 1) readonly buffer Rows { uvec4 rows[]; };       // above, below, target
layout(binding = 2) readonly buffer States { float state[]; };
layout(binding = 3) buffer Rest { float rest[]; };
layout(push_constant) uniform Constants {
  vec4 x, y, z;
  uint vertex_count;
};
const uint k_lanes = 16u;

vec3 place(uint at) { return vec3(state[at], state[at + k_lanes], state[at + 2u * k_lanes]); }

void main() {
  uint i = invocation();
  if (i >= vertex_count) return;
  vec4 fixed_part = numbers[2u * i], along = numbers[2u * i + 1u];
  uvec4 at = rows[i];
  vec3 guide = guide_place(place(at.x), place(at.y), along.x);
  if (!leads(guide, along.y)) return;
  vec3 aim = clump_aim(fixed_part.xyz, fixed_part.w, guide, x.xyz, y.xyz, z.xyz);
  for (uint c = 0u; c < 3u; ++c) rest[at.z + c * k_lanes] = aim[c];
}
