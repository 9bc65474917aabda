// Push constants of the kernels of maps (MapPush of map_gpu.h, word for word), and the light's view.
#include "shadows/light_frame.glslh"

layout(push_constant) uniform Push {
  vec4 right, up, forward;   // xyz; w: what they give at the world's origin
  float intervals;           // depth steps from the near to the far plane
  float filter_texels;       // radius of the lookup's disc
  float filter_radius;       // the same in metres, used where it is not 0
  float per_unit;            // -k / scale
  uint resolution;           // squared: most texels
  uint layers;
  uint count;                // of segments, texels or vertices
  uint flags;                // k_poisson and the method's own
  float pieces_per_step;     // of a segment, per depth step
  float own[2];              // the method's own numbers
  float fibre_width;         // of the fibres that a strand stands for, as a share of its own
  float depth_offset;        // metres behind a point that fibres still count
  float caster_width;        // factor on the radii of segments
  float reach;               // of seen_by_light: 0 for a distant light
  uint segment_count;        // of those that cast
  uint strip_word;           // strip_number(), strip_count(), strip_margin()
  float eye[3];              // the viewer, metres, where k_seen is set
} push;
/// Parts of a segment that casts: there are vertices between its ends, on one line.
uint segment_parts() { return (push.flags >> 16 & 0x3fu) + 1u; }
const uint k_poisson = 1u;
const uint k_intervals = 0x10000000u;    // the map does not know depths, but how much hair an interval of depth holds
const uint k_byte_target = 0x20000000u;  // a number in a drawn target is one of 255 whole steps
const uint k_seen = 0x40000000u;         // points lie on the surface that the viewer sees, not on axes
const uint k_square = 0x80000000u;  // the map is one, whatever the shape of the hair

#ifndef MAP_IS_DRAWN  // by a vertex shader, which has no groups
#include "gpu/groups.glsl"
#endif

vec3 in_light_axes(vec3 p) {
  const vec3 origin = vec3(push.right.w, push.up.w, push.forward.w);
  return seen_by_light(light_point(push.right.xyz, push.up.xyz, push.forward.xyz, origin, p), push.reach);
}

/// The unit direction in which the light passes a world point.
vec3 way_of_light(vec3 p) {
  const vec3 origin = vec3(push.right.w, push.up.w, push.forward.w);
  return light_way(push.right.xyz, push.up.xyz, push.forward.xyz, origin, p, push.reach);
}

/// The box is kept as least values of the ordered bits of (x, y, z, -x, -y, -z).
vec3 lower_of(uint least[6]) {
  return vec3(from_ordered_bits(least[0]), from_ordered_bits(least[1]), from_ordered_bits(least[2]));
}
vec3 upper_of(uint least[6]) {
  return -vec3(from_ordered_bits(least[3]), from_ordered_bits(least[4]), from_ordered_bits(least[5]));
}
uint columns, rows;  // of the map, once it is placed
// Of a map in strips: rows that are looked up now, and texels that are kept for them.
uint own_first_row, own_end_row, first_kept, end_kept;

/// Strips of rows are filled and looked up one after the other; one strip: the whole map. Lookups read some rows beside.
uint strip_number() { return push.strip_word & 0xffu; }
uint strip_count() { return (push.strip_word >> 8) & 0xffu; }
uint strip_margin() { return push.strip_word >> 16; }
uint strip_row(uint strip) { return uint(float(rows * strip) / float(strip_count())); }
void place_strip() {
  own_first_row = strip_row(strip_number());
  own_end_row = strip_row(strip_number() + 1u);
  first_kept = columns * (own_first_row - min(own_first_row, strip_margin()));
  end_kept = columns * min(rows, own_end_row + strip_margin());
}
/// Whether a texel, i + j * columns, is kept, and where.
bool is_kept(uint texel) { return texel >= first_kept && texel < end_kept; }
uint kept_place(uint texel) { return texel - first_kept; }

MapPlacement placement_of(uint least[6]) {
  const float least_share = (push.flags & k_square) != 0u ? k_square_shape : k_any_shape;
  const MapPlacement placement =
      map_placement(lower_of(least), upper_of(least), push.resolution, push.intervals, least_share);
  columns = placement.columns;
  rows = placement.rows;
  place_strip();
  return placement;
}
