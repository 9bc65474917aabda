#version 460
#extension GL_GOOGLE_include_directive : require
// Coarse rasteriser, first half: how many segments each tile has, and which vertices are seen.
layout(local_size_x = 64) in;
#include "render/passes/tile_lists/tile_walk.glsl"
#define STRAND_LIST_BINDING 7
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 4) buffer Counts { uint counts[]; };
layout(std430, binding = 5) buffer Visible { uint visible[]; };
layout(std430, binding = 6) buffer Statistics { uint wanted, not_finite; };

void visit(uint tile, uint vertex, float inverse_depth) { atomicAdd(counts[tile], 1u); }

void see(uint vertex) { atomicOr(visible[vertex >> 5], 1u << (vertex & 31u)); }

void main() {
  uint segment = listed_segment(invocation());
  if (segment >= push.segment_count) return;
  uint vertex = texelFetch(segments, int(segment)).r;
  vec4 a = texelFetch(vertices, int(vertex)), b = texelFetch(vertices, int(vertex + 1u));
  if (!is_finite(a) || !is_finite(b)) {
    atomicAdd(not_finite, 1u);
    return;
  }
  Projected p;
  if (!is_kept(vertex) || !project(a, b, p) || walk(vertex, p) == 0u) return;
  see(vertex);
  see(vertex + 1u);
}
