#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: how many fragments it leaves in every texel it covers.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) buffer Next { uint next[]; };

void deposit(uint texel, uint covered, uint depth_step) {
  if (table[covered] > 0u && is_kept(texel)) atomicAdd(next[texel], 1u);
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
