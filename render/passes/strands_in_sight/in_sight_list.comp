#version 460
#extension GL_GOOGLE_include_directive : require
// One workgroup: the list of the strands in sight, in their order, and how many workgroups their vertices and segments
// take (groups_for of gpu/groups.h). Every invocation has a run of words.
layout(local_size_x = 256) in;
#include "render/passes/strands_in_sight/in_sight_push.glsl"

layout(std430, binding = 0) readonly buffer Seen { uint seen[]; };
layout(std430, binding = 1) writeonly buffer List {
  uint count, row;
  uint vertex_groups[3], segment_groups[3];
  uint list[];
};

shared uint sums[256];

uvec3 groups_for(uint threads) {
  const uint k_row = 32768u, groups = (threads + 63u) / 64u;
  return groups <= k_row ? uvec3(groups, 1u, 1u) : uvec3(k_row, (groups + k_row - 1u) / k_row, 1u);
}

void main() {
  const uint lane = gl_LocalInvocationID.x, words = (strand_count + 31u) / 32u, run = (words + 255u) / 256u;
  const uint begin = min(lane * run, words), end = min(begin + run, words);
  uint sum = 0u;
  for (uint word = begin; word < end; ++word) sum += bitCount(seen[word]);
  sums[lane] = sum;
  barrier();
  uint next = 0u;
  for (uint k = 0u; k < lane; ++k) next += sums[k];
  for (uint word = begin; word < end; ++word)
    for (uint bits = seen[word]; bits != 0u; bits &= bits - 1u) list[next++] = 32u * word + uint(findLSB(bits));
  if (lane < 255u) return;
  count = next;
  row = vertices_per_strand;
  const uvec3 of_vertices = groups_for(next * vertices_per_strand),
              of_segments = groups_for(next * (vertices_per_strand - 1u));
  for (int axis = 0; axis < 3; ++axis) {
    vertex_groups[axis] = of_vertices[axis];
    segment_groups[axis] = of_segments[axis];
  }
}
