#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup: the list of the strands in sight, in their order, and how many workgroups their vertices and segments
// take.
layout(local_size_x = 256) in;
#include "render/passes/strands_in_sight/in_sight_push.glsl"

layout(std430, binding = 0) readonly buffer Seen { uint seen[]; };
layout(std430, binding = 1) writeonly buffer List {
  uint count, row;
  uint vertex_groups[3], segment_groups[3];
  uint list[];
};

#define BITS(word) seen[word]
#define LISTED(place) list[place]
#include "gpu/list_of_bits.glsl"

void main() {
  const uint listed = list_bits(strand_count);
  if (gl_LocalInvocationID.x < 255u) return;
  count = listed;
  row = vertices_per_strand;
  const uvec3 of_vertices = groups_for(listed * vertices_per_strand),
              of_segments = groups_for(listed * (vertices_per_strand - 1u));
  for (int axis = 0; axis < 3; ++axis) {
    vertex_groups[axis] = of_vertices[axis];
    segment_groups[axis] = of_segments[axis];
  }
}
