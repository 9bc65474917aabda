#version 460
#extension GL_GOOGLE_include_directive : require
// Nodes that no vertex was near take the mean of those around them that have a value.
#include "render/passes/velocity/velocity.glsl"
layout(std430, binding = 1) readonly buffer From { vec4 from[]; };
layout(std430, binding = 2) writeonly buffer To { vec4 to[]; };

void main() {
  uint node = invocation();
  if (node >= nodes * nodes * nodes) return;
  ivec3 place = ivec3(node % nodes, node / nodes % nodes, node / (nodes * nodes));
  ivec3 first = max(place - 1, ivec3(0)), last = min(place + 1, ivec3(nodes - 1u));
  vec4 sum = vec4(0.0);
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) sum += from[node_index(uvec3(x, y, z))];
  to[node] = from[node].w > 0.0 || sum.w == 0.0 ? from[node] : vec4(sum.xyz / sum.w, 1.0);
}
