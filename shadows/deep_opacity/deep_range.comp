#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: the nearest depth step of every texel it covers, and the complement of the farthest.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"

layout(std430, binding = 3) buffer Depths { uint depths[]; };
layout(binding = 4) uniform usamplerBuffer found;  // the same

void deposit(uint texel, uint covered, uint depth_step) {
  const int nearest = int(2u * texel);
  if (depth_step < texelFetch(found, nearest).r) atomicMin(depths[nearest], depth_step);
  if (~depth_step < texelFetch(found, nearest + 1).r) atomicMin(depths[nearest + 1], ~depth_step);
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
