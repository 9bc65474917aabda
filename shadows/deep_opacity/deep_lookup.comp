#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: looks it up in a map of all texels.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/deep_exponent.glsl"
#define STRAND_LIST_BINDING 8
#include "strands/lod/strand_list.glsl"

float exponent_at(uint texel, float z) { return stored_exponent(texel, z); }

/// Brings the sums around a point near at once: a filter's texels are read one after the other, and wait for memory one
/// by one. True where all are the largest number, which sums never are.
bool is_damaged(vec2 p) {
  const ivec2 at = clamp(ivec2(floor(p)), ivec2(1, own_first_row + 1u), ivec2(columns, own_end_row) - 2);
  uint all = 0xffffffffu;
  for (int j = at.y - 1; j <= at.y + 1; ++j)
    for (int i = at.x - 1; i <= at.x + 1; i += 2)
      all &= texelFetch(sums, int((uint(j) * columns + uint(i) - first_stored) * push.layers)).r;
  return all == 0xffffffffu && k_packed == 0u;
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v >= push.count) return;
  const MapPlacement placement = placement_of(least);
  first_stored = k_packed != 0u ? 0u : first_kept;  // codes are kept of all strips
  const vec3 seen = in_light_axes(drawn_vertex(v).xyz);
  if (!is_damaged(place_in_map(placement, seen).xy)) look_up(placement, v);
}
