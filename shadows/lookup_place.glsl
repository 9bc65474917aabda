// Where a receiver is looked up; for compute and vertex shaders, after map_geometry.glsl.
#include "shadows/filter.glslh"
#include "shadows/own_fibre.glslh"

/// On the surface that the viewer sees; and how far before it, metres, the axes of fibres that hold it may lie.
struct LookupPlace {
  vec3 point;
  float held;
  bool is_seen;  // by a viewer
  float clearance;  // seen_clearance() there
  float power;   // seen_power() of a place that a viewer sees, on a strand that casts or not; else 1
};
/// Of a point of a strand's axis, metres; `along` the strand, or zero for a point that lies on none that casts.
LookupPlace lookup_place(vec3 on_axis, vec3 along, float radius) {
  const bool is_on_strand = dot(along, along) > 0.0;
  const bool has_viewer = (push.flags & k_seen) != 0u;
  LookupPlace place = LookupPlace(on_axis, 0.0, is_on_strand && has_viewer, 1.0, 1.0);
  const vec3 way = way_of_light(on_axis), eye = vec3(push.eye[0], push.eye[1], push.eye[2]);
  const float cosine = cosine_seen_from(eye - on_axis, way);
  if (has_viewer) place.power = seen_power(cosine);
  if (!is_on_strand) return place;
  const float fibre_radius = radius * push.fibre_width;
  place.held = half_crossing(along, way, fibre_radius * push.caster_width);
  if (!place.is_seen) return place;
  place.clearance = seen_clearance(cosine);
  place.held *= fibre_clearance(along, eye - on_axis, way, fibre_radius * push.caster_width);
  place.point += to_seen_surface(on_axis, along, eye, fibre_radius);
  return place;
}

/// Metres before a place, which the light sees at `seen`, within which fibres do not count: those that hold it, and
/// blur_depth() where a viewer sees it; not with a filter in metres, whose mean over the disc is what is asked for.
float free_depth(MapPlacement placement, LookupPlace place, vec3 seen) {
  const float texels_per_metre = placement.scale.x * view_scale(seen, push.reach);
  const bool is_blurred = place.is_seen && !(push.filter_radius > 0.0);
  const float share = (push.flags & k_intervals) != 0u ? k_interval_blur : 1.0;
  return place.held + (is_blurred ? share * place.clearance * blur_depth(push.filter_texels, texels_per_metre) : 0.0);
}
/// Depth in the map up to which fibres count, in steps; `z` in the map of a place that the light sees at `seen`.
float depth_looked_up(MapPlacement placement, LookupPlace place, vec3 seen, float z) {
  return lookup_depth(z, push.depth_offset - free_depth(placement, place, seen), placement.scale.z);
}
