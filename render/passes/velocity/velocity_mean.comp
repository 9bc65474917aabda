#version 460
#extension GL_GOOGLE_include_directive : require
// Sums to means; w: 1 where any vertex was near.
#include "render/passes/velocity/velocity.glsl"
layout(std430, binding = 1) readonly buffer Sums { int sums[]; };
layout(std430, binding = 2) readonly buffer Largest { float largest; };
layout(std430, binding = 3) writeonly buffer Grid { vec4 grid[]; };

void main() {
  uint node = invocation();
  if (node >= nodes * nodes * nodes) return;
  vec3 sum = vec3(sums[4u * node], sums[4u * node + 1u], sums[4u * node + 2u]);
  float weight = float(sums[4u * node + 3u]);
  grid[node] = weight > 0.0 ? vec4(sum / weight * largest, 1.0) : vec4(0.0);
}
