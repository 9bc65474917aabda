#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the box of all vertices along the light's axes. Minima of integers, so any order gives the same.
layout(local_size_x = 64) in;
#include "cuticle/shadows/map_geometry.glsl"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) buffer Box { uint least[6]; };

shared uint group_least[6];

void main() {
  const uint lane = gl_LocalInvocationID.x;
  if (lane < 6u) group_least[lane] = 0xffffffffu;
  barrier();
  const uint v = min(invocation(), push.count - 1u);
  const vec3 point = in_light_axes(vertices[v].xyz);
  for (int axis = 0; axis < 3; ++axis) {
    atomicMin(group_least[axis], ordered_bits(point[axis]));
    atomicMin(group_least[axis + 3], ordered_bits(-point[axis]));
  }
  barrier();
  if (lane < 6u) atomicMin(least[lane], group_least[lane]);
}
