#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation: totals become what lies before each; the last list ends behind the last texel. The fullest strip's number
// of fragments stands behind the totals.
layout(local_size_x = 64) in;
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) writeonly buffer First { uint first[]; };
layout(std430, binding = 1) buffer Totals { uint totals[]; };

void main() {
  if (invocation() != 0u) return;
  uint before = 0u;
  for (uint row = 0u; row < push.resolution; ++row) {
    const uint total = totals[row];
    totals[row] = before;
    before += total;
  }
  first[push.resolution * push.resolution] = before;
  totals[push.resolution] = max(totals[push.resolution], before);
}
