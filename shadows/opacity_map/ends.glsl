// N19, weights=per_vertex: a vertex between the ends of a segment takes the tent weights of the ends' depths, as a
// rasteriser interpolates what a vertex shader made. After map_filter.glsl.
layout(constant_id = 0) const bool VERTEX_WEIGHTS = false;

bool is_between_ends = false;
float depths_of_ends[2];  // in plane spacings
float share_of_last;

float depth_of_end(MapPlacement placement, uint s, uint segment_at, uint end) {
  const LookupPlace there = lookup_place(drawn_vertex(end).xyz, s, segment_at);
  const vec3 seen = in_light_axes(there.point);
  return clamp(depth_looked_up(placement, there, seen, place_in_map(placement, seen).z), 0.0, push.intervals);
}

/// Where vertex v has its segment's first vertex before it and its last behind it.
void find_ends(MapPlacement placement, uint v) {
  if (!VERTEX_WEIGHTS) return;
  const OwnPlace own = own_place(v);
  const uint parts = segment_parts();
  is_between_ends = own.at < v;
  if (!is_between_ends) return;
  depths_of_ends[0] = depth_of_end(placement, own.s, own.at, own.at);
  depths_of_ends[1] = depth_of_end(placement, own.s, own.at, own.at + parts);
  share_of_last = float(v - own.at) / float(parts);
}
