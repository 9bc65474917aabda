#version 460
#extension GL_GOOGLE_include_directive : require
// The largest component of any vertex's displacement: the unit of the sums of integers.
#include "render/passes/velocity/velocity.glsl"
#include "render/finite.glsl"
layout(std430, binding = 1) readonly buffer Now { vec4 now[]; };
layout(std430, binding = 2) readonly buffer Motion { vec4 motion[]; };
layout(std430, binding = 3) buffer Largest { uint largest; };  // bits of a float that is not negative: these order alike

void main() {
  uint vertex = invocation();
  if (vertex >= vertex_count || !is_finite(now[vertex]) || !is_finite(motion[vertex])) return;
  vec3 way = abs(moved(now[vertex], motion[vertex]));
  atomicMax(largest, floatBitsToUint(max(way.x, max(way.y, way.z))));
}
