// A strand segment in the map, for compute and vertex shaders.
#include "shadows/map_geometry.glsl"
#include "shadows/splat.glslh"

layout(binding = 0) uniform samplerBuffer vertices;
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

/// The first vertex of segment s.
uint first_vertex(uint s) { return texelFetch(segments, int(s)).r; }

MapSegment map_segment(uint s) {
  const uint v = first_vertex(s);
  const vec4 first = texelFetch(vertices, int(v)), last = texelFetch(vertices, int(v + 1u));
  const MapPlacement placement = placement_of(least);
  precise float radius_sum = first.w + last.w;
  const vec3 a = in_light_axes(first.xyz), b = in_light_axes(last.xyz);
  precise float half_width = 0.5 * radius_sum * push.caster_width * placement.scale.x * segment_scale(a, b, push.reach);
  MapSegment segment;
  segment.a = place(placement, a);
  segment.b = place(placement, b);
  segment.half_width = half_width;
  segment.is_first = s == 0u || first_vertex(s - 1u) + 1u != v;
  segment.is_last = s + 1u == push.segment_count || first_vertex(s + 1u) != v + 1u;
  return segment;
}
