// A strand segment in the map, for compute and vertex shaders.
#include "shadows/map_geometry.glsl"
#include "shadows/splat.glslh"

#define VERTICES_BINDING 0
#include "strands/spline/drawn.glsl"
layout(binding = 1) uniform usamplerBuffer segments;
layout(std430, binding = 2) readonly buffer Box { uint least[6]; };

struct MapSegment {
  vec3 a, b;
  float half_width;
  bool is_first, is_last;  // of its strand
};

vec3 place(MapPlacement placement, vec3 seen) {
  const vec3 point = place_in_map(placement, seen);
  return vec3(snap(point.x), snap(point.y), point.z);
}

/// The first vertex of segment s, which ends segment_parts() vertices after it.
uint first_vertex(uint s) { return texelFetch(segments, int(s * segment_parts())).r; }

struct MapVertex {
  vec3 seen;  // by the light
  float radius;
};
MapVertex map_vertex(uint v) {
  const vec4 vertex = drawn_vertex(v);
  return MapVertex(in_light_axes(vertex.xyz), vertex.w);
}

MapSegment segment_between(MapPlacement placement, MapVertex first, MapVertex last, bool is_first, bool is_last) {
  precise float radius_sum = first.radius + last.radius;
  precise float half_width =
      0.5 * radius_sum * push.caster_width * placement.scale.x * segment_scale(first.seen, last.seen, push.reach);
  MapSegment segment;
  segment.a = place(placement, first.seen);
  segment.b = place(placement, last.seen);
  segment.half_width = half_width;
  segment.is_first = is_first;
  segment.is_last = is_last;
  return segment;
}

MapSegment map_segment(uint s) {
  const uint v = first_vertex(s), end = v + segment_parts();
  const bool is_first = s == 0u || first_vertex(s - 1u) + segment_parts() != v;
  const bool is_last = s + 1u == push.segment_count || first_vertex(s + 1u) != end;
  return segment_between(placement_of(least), map_vertex(v), map_vertex(end), is_first, is_last);
}
