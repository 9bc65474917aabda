#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel: what lies in each layer becomes what lies before its end, by summing along the depth.
layout(local_size_x = 64) in;
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) buffer Sums { uint sums[]; };

void main() {
  const uint t = invocation();
  if (t >= push.count) return;
  uint total = 0u;
  for (uint i = t * push.layers; i < (t + 1u) * push.layers; ++i) {
    total += sums[i];
    sums[i] = total;
  }
}
