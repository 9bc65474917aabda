#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per strand: whether it may be in the picture. It is not where all of it, with its width, is beyond one
// side of the view, or behind the camera. A strand with numbers that are none counts as seen, so that it is counted.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/finite.glsl"
#include "render/passes/strands_in_sight/in_sight_push.glsl"

#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
layout(std430, binding = 1) buffer Seen { uint seen[]; };  // a bit per strand

// A bit for each side of the view that the vertex is beyond.
uint sides_beyond(vec4 vertex) {
  if (!is_finite(vertex)) return 0u;
  const vec4 clip = world_to_clip * vec4(vertex.xyz, 1.0);
  const vec2 reach = side * max(clip.w, 0.0) + per_radius * vertex.w;
  return uint(clip.x < -reach.x) | uint(clip.x > reach.x) << 1 | uint(clip.y < -reach.y) << 2 |
         uint(clip.y > reach.y) << 3 | uint(clip.w <= 0.0) << 4;
}

void main() {
  const uint strand = invocation();
  if (strand >= strand_count) return;
  uint beyond = 31u;
  for (uint k = 0u; k < vertices_per_strand && beyond != 0u; ++k)
    beyond &= sides_beyond(drawn_vertex(strand * vertices_per_strand + k));
  if (beyond == 0u) atomicOr(seen[strand >> 5], 1u << (strand & 31u));
}
