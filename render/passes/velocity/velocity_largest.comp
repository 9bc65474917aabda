#version 460
#extension GL_GOOGLE_include_directive : require
// The largest component of any vertex's displacement: the unit of the sums of integers.
#include "render/passes/velocity/velocity.glsl"
#include "render/finite.glsl"
layout(binding = 1) uniform samplerBuffer now;
layout(binding = 2) uniform samplerBuffer motion;
layout(std430, binding = 3) buffer Largest { uint largest; };  // bits of a float that is not negative: these order alike

void main() {
  uint vertex = invocation();
  if (vertex >= vertex_count) return;
  const vec4 place = texelFetch(now, int(vertex)), moves = texelFetch(motion, int(vertex));
  if (!is_finite(place) || !is_finite(moves)) return;
  vec3 way = abs(moved(place, moves));
  atomicMax(largest, floatBitsToUint(max(way.x, max(way.y, way.z))));
}
