// Walks the pieces of a strand segment. The shader that includes this defines piece(), which is called for each.
#include "cuticle/shadows/map_geometry.glsl"
#include "cuticle/shadows/splat.glslh"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Segments { uint segments[]; };
layout(std430, binding = 2) readonly buffer Box { uint least[6]; };

void piece(Footprint footprint);

vec3 place(MapPlacement placement, vec3 p) {
  const vec3 point = place_in_map(placement, in_light_axes(p));
  return vec3(snap(point.x), snap(point.y), point.z);
}

/// Segment s in pieces at most 1 / steps_to_pieces depth steps deep.
void walk_segment(uint s, float steps_to_pieces) {
  const uint v = segments[s];
  const bool is_first = s == 0u || segments[s - 1u] + 1u != v;
  const bool is_last = s + 1u == push.count || segments[s + 1u] != v + 1u;
  const MapPlacement placement = placement_of(least);
  const vec3 a = place(placement, vertices[v].xyz), b = place(placement, vertices[v + 1u].xyz);
  precise float radius_sum = vertices[v].w + vertices[v + 1u].w;
  precise float half_width = 0.5 * radius_sum * placement.scale.x;
  const float size = segment_footprint(a, b, half_width, 0.0, 0.0).size;
  const uint pieces = piece_count(a.z * steps_to_pieces, b.z * steps_to_pieces, size);
  for (uint i = 0u; i < pieces; ++i)
    piece(segment_footprint(piece_point(a, b, i, pieces), piece_point(a, b, i + 1u, pieces), half_width,
                            is_first && i == 0u ? 1.0 : 0.0, is_last && i + 1u == pieces ? 1.0 : 0.0));
}
