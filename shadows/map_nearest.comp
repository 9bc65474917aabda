#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: the nearest depth step of every texel it covers.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"

layout(std430, binding = 3) buffer Nearest { uint nearest[]; };

void deposit(uint texel, uint covered, uint depth_step) { atomicMin(nearest[texel], depth_step); }

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
