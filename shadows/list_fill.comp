#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: writes its fragments into the texels' lists, in any order. Those behind the room are lost.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) buffer Next { uint next[]; };
layout(std430, binding = 5) writeonly buffer Fragments { uvec2 fragments[]; };

void deposit(uint texel, uint covered, uint depth_step) {
  if (table[covered] == 0u || !is_kept(texel)) return;
  const uint at = atomicAdd(next[texel], 1u);
  if (at < push.layers) fragments[at] = uvec2(depth_step, table[covered]);
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
