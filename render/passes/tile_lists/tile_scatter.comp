#version 460
#extension GL_GOOGLE_include_directive : require
// Coarse rasteriser, second half: each tile's segments, in an order that the sort makes definite.
layout(local_size_x = 64) in;
#include "render/passes/tile_lists/tile_walk.glsl"
#define STRAND_LIST_BINDING 6
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 4) buffer Counts { uint counts[]; };  // where the tile's next entry goes
layout(std430, binding = 5) writeonly buffer Entries { uvec2 entries[]; };  // 1 / depth, first vertex

void visit(uint tile, uint vertex, float inverse_depth) {
  uint place = atomicAdd(counts[tile], 1u);
  if (place < push.capacity) entries[place] = uvec2(floatBitsToUint(inverse_depth), vertex);
}

void main() {
  uint segment = listed_segment(invocation(), k_parts);
  if (segment >= push.segment_count) return;
  uint vertex = first_vertex(segment);
  vec4 a = drawn_vertex(vertex), b = drawn_vertex(vertex + k_parts);
  Projected p;
  if (is_finite(a) && is_finite(b) && is_kept(vertex) && project(a, b, p)) walk(vertex, p);
}
