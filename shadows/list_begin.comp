#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel: where its list begins, and where its first fragment is to be written.
layout(local_size_x = 64) in;
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) buffer First { uint first[]; };
layout(std430, binding = 1) readonly buffer Totals { uint totals[]; };
layout(std430, binding = 2) writeonly buffer Next { uint next[]; };

void main() {
  const uint t = invocation();
  if (t >= push.count) return;
  const uint begin = first[t] + totals[t / push.resolution];
  first[t] = begin;
  next[t] = begin;
}
