// The mean over a lookup's disc of T, or of the optical depth. The shader that includes this defines exponent_at(), and
// own_deposit() of map_own.glsl.
#include "shadows/filter.glslh"
#include "shadows/map_own.glsl"

/// -k sigma before depth z (in steps) at a texel of the map, own_texel, without what walk_own() finds there.
float exponent_at(uint texel, float z);

float lookup_power = 1.0;  // LookupPlace::power of the lookup

float averaged(int i, int j, float z) {
  const bool outside = i < 0 || j < 0 || i >= int(columns) || j >= int(rows);
  own_texel = ivec2(i, j);
  const float exponent = outside ? 0.0 : exponent_at(uint(j) * columns + uint(i), z);
  return (push.flags & k_poisson) != 0u ? exponent : exp(exponent);
}

/// Over the disc. Loops end at their last line: on lavapipe one that asks first runs its body once more, masked.
float mean_over_disc(vec2 p, float z, float radius) {
  const int reach = disc_reach(radius), j0 = int(floor(p.y));
  float sum = 0.0, weights = 0.0;
  int j = j0 - reach;
  do {
    const float half_row = disc_half_row(float(j) + 0.5 - p.y, radius);
    const int last = disc_last(p.x, half_row, radius);
    enter_own_row(j);
    int i = disc_first(p.x, half_row, radius);
    do {
      const float weight = i > last ? 0.0 : disc_weight(length(vec2(i, j) + 0.5 - p), radius);
      sum += weight * averaged(i, j, z);
      weights += weight;
    } while (++i <= last);
  } while (++j <= j0 + reach);
  return (push.flags & k_poisson) != 0u ? exp(sum / weights) : min(1.0, sum / weights);
}

/// Lookups with many pieces of their own fibre go through the disc by loops of their own. On lavapipe a condition within
/// the loops runs what it guards at every texel, masked; here a disc that no invocation asks for costs its first texel.
float mean_transmittance(vec2 p, float z, float radius) {
  float mean = 0.0;
  if (own_pieces <= k_kept_pieces) {
    are_kept = true;
    mean = mean_over_disc(p, z, radius);
  } else {
    are_kept = false;
    mean = mean_over_disc(p, z, radius);
  }
  return mean;
}

/// Whether a point in row y of the map is looked up in the strip that is kept now.
bool is_in_strip(float y) {
  const uint row = uint(clamp(floor(y), 0.0, float(rows) - 1.0));
  return row >= own_first_row && row < own_end_row;
}

/// The transmittance at a point of an axis, metres, that lies at vertex v, where segment s begins or would, or on that
/// segment: 1 far outside the map, -1 in another strip. Depths are limited to 0 .. deepest, in steps.
float transmittance_at(MapPlacement placement, vec3 position, uint s, uint v, float deepest) {
  const LookupPlace there = lookup_place(position, s, v);
  const vec3 seen = in_light_axes(there.point), point = place_in_map(placement, seen);
  const float texels = push.filter_radius * placement.scale.x * view_scale(seen, push.reach);
  const float radius = push.filter_radius > 0.0 ? clamp(texels, 0.5, k_max_filter_radius) : push.filter_texels;
  lookup_power = there.power;
  if (!is_in_strip(point.y)) return -1.0;
  const float limit = float(max(columns, rows)) + 130.0;
  if (!(abs(point.x) < limit && abs(point.y) < limit) || !is_seen_by_light(seen, push.reach)) return 1.0;
  find_own(placement, s, v, seen, point.xy, radius);
  const float z = clamp(depth_looked_up(placement, there, seen, point.z), 0.0, deepest);
  return mean_transmittance(point.xy, z, radius);
}

/// The same at vertex v.
float transmittance_of_vertex(MapPlacement placement, uint v, float deepest) {
  const OwnPlace own = own_place(v);
  return transmittance_at(placement, drawn_vertex(v).xyz, own.s, own.at, deepest);
}
