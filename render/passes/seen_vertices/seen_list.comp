#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup: the list of the vertices whose bit is set, in their order, and how many workgroups they take.
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Bits { uint bits[]; };
layout(std430, binding = 1) writeonly buffer List { uint count, groups[3], list[]; };
layout(push_constant) uniform Push { uint vertex_count; };

#define BITS(word) bits[word]
#define LISTED(place) list[place]
#include "gpu/list_of_bits.glsl"

void main() {
  const uint listed = list_bits(vertex_count);
  if (gl_LocalInvocationID.x < 255u) return;
  count = listed;
  const uvec3 of_vertices = groups_for(listed);
  for (int axis = 0; axis < 3; ++axis) groups[axis] = of_vertices[axis];
}
