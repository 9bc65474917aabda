#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per strand: whether any of its segments may show, and how many have numbers that are none. Wherever it
// is in doubt a strand is drawn.
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/finite.glsl"
#include "render/passes/cull_strands/cull_push.glsl"
#include "render/visibility/segment_ends.glsl"

#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
layout(std430, binding = 1) readonly buffer TileDepth { float tile_depth[]; };
layout(std430, binding = 2) buffer Seen { uint seen[]; };  // a bit per strand
layout(std430, binding = 3) buffer Lost { uint lost_segments; };

const float k_doubt = 1e-4;        // relative, in distances
const float k_depth_doubt = 1e-6;  // of a stored depth: 16 times its last bit

bool any_tile_open(vec2 least, vec2 most, float nearest) {
  const ivec2 grid = ivec2(tile_grid());
  const ivec2 first = max(ivec2(floor(least / float(k_tile))), ivec2(0)),
              last = min(ivec2(floor(most / float(k_tile))), grid - 1);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (nearest >= tile_depth[y * grid.x + x]) return true;
  return false;
}

// Sides stand in planes of equal distance, so that a segment lies within the box around its ends, wider by half its width.
bool may_show(vec4 a, vec4 b) {
  const vec4 clip_a = world_to_clip * vec4(a.xyz, 1.0), clip_b = world_to_clip * vec4(b.xyz, 1.0);
  const vec2 distances = vec2(clip_a.w, clip_b.w);
  if (all(lessThan(distances, vec2(near * (1.0 - k_doubt)))) || all(greaterThan(distances, vec2(far * (1.0 + k_doubt)))))
    return false;
  if (any(lessThan(distances, vec2(near)))) return true;
  const vec2 inverse = 1.0 / distances;
  const vec2 from = (clip_a.xy * inverse.x * 0.5 + 0.5) * vec2(size), to = (clip_b.xy * inverse.y * 0.5 + 0.5) * vec2(size);
  const float widest = max(a.w * inverse.x, b.w * inverse.y) * width_scale;
  const float reach = max(widest, least_half_width) + 1.0;
  const vec2 least = clamp(min(from, to) - reach, vec2(-1e6), vec2(1e6)),
             most = clamp(max(from, to) + reach, vec2(-1e6), vec2(1e6));
  return any_tile_open(least, most, max(inverse.x, inverse.y) + k_depth_doubt / near);
}

void main() {
  const uint strand = invocation();
  if (strand >= strand_count) return;
  bool shows = false;
  uint lost = 0u;
  vec4 a = drawn_vertex(vertex_of(strand, 0u));
  for (uint k = 0u; k < drawn_segments; ++k) {
    const vec4 b = drawn_vertex(vertex_of(strand, k + 1u));
    if (!is_finite(a) || !is_finite(b)) ++lost;
    else if (!shows) shows = may_show(a, b);
    a = b;
  }
  if (shows) atomicOr(seen[strand >> 5], 1u << (strand & 31u));
  if (lost > 0u) atomicAdd(lost_segments, lost);
}
