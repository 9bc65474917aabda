#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per push.resolution texels: where their lists would begin if the first of them began at 0.
layout(local_size_x = 64) in;
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) readonly buffer Next { uint next[]; };
layout(std430, binding = 1) writeonly buffer First { uint first[]; };
layout(std430, binding = 2) writeonly buffer Totals { uint totals[]; };

void main() {
  const uint row = invocation();
  if (row >= push.count) return;
  uint total = 0u;
  for (uint t = row * push.resolution; t < (row + 1u) * push.resolution; ++t) {
    first[t] = total;
    total += next[t];
  }
  totals[row] = total;
}
