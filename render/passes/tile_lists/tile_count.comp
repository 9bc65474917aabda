#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Coarse rasteriser, first half: how many segments each tile has, and which vertices are seen.
layout(local_size_x = 64) in;
#include "render/passes/tile_lists/tile_walk.glsl"
#define STRAND_LIST_BINDING 7
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 4) buffer Counts { uint counts[]; };
layout(std430, binding = 5) buffer Visible { uint visible[]; };
layout(std430, binding = 6) buffer Statistics { uint wanted, not_finite; };

void visit(uint tile, uint vertex, float inverse_depth) { atomicAdd(counts[tile], 1u); }

// The vertices of a segment, a word of their bits at a time.
void see_from(uint first) {
  const uint last = first + k_parts, words = (k_parts >> 5) + 2u;
  [[unroll]] for (uint k = 0u; k < words; ++k) {
    const uint word = (first >> 5) + k;
    const uint from = k == 0u ? ~0u << (first & 31u) : ~0u, to = word == last >> 5 ? ~0u >> (31u - (last & 31u)) : ~0u;
    if (word <= last >> 5) atomicOr(visible[word], from & to);
  }
}

void main() {
  uint segment = listed_segment(invocation(), k_parts);
  if (segment >= push.segment_count) return;
  uint vertex = first_vertex(segment);
  vec4 a = drawn_vertex(vertex), b = drawn_vertex(vertex + k_parts);
  if (!is_finite(a) || !is_finite(b)) {
    atomicAdd(not_finite, 1u);
    return;
  }
  Projected p;
  if (!is_kept(vertex) || !project(a, b, p) || walk(vertex, p) == 0u) return;
  see_from(vertex);
}
