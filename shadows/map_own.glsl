// What a receiver's own fibre has left in the texels of its lookup: the pieces of the segments around it, whose deposits
// are found again by the arithmetic that made them. The shader that includes this defines own_deposit().
#include "shadows/map_segments.glsl"
#include "shadows/own_segments.glsl"

/// Called by walk_own() for every deposit in the texel.
void own_deposit(uint covered, uint depth_step);

const uint k_kept_pieces = 6u;  // of a lookup; more are made again for every texel
Footprint kept[k_kept_pieces];
uint own_pieces = 0u;
ivec2 own_texel;

/// Keeps a piece as long as there is room.
void piece(Footprint footprint) {
  if (own_pieces < k_kept_pieces) kept[own_pieces] = footprint;
  ++own_pieces;
}

void visit_own(Footprint footprint) {
  const vec2 offset = texel_offset(footprint.from, own_texel.x, own_texel.y);
  const uint covered = coverage_index(coverage(footprint, offset));
  if (covered > 0u) own_deposit(covered, uint(max(0, depth_bin(footprint, offset))));
}

/// Of segments that are not kept: those that may cover a row of texels, and the columns where they may.
uint row_begin, row_end;
vec2 row_columns;
void enter_own_row(int j) {
  row_begin = own_end;
  row_end = own_begin;
  row_columns = vec2(3e38, -3e38);
  if (own_pieces <= k_kept_pieces) return;
  for (uint s = own_begin; s < own_end; ++s) {
    const MapSegment segment = map_segment(s);
    const bool is_tip = segment.is_first || segment.is_last;
    const vec2 margin = vec2((is_tip ? 1.8 : 1.0) * segment.half_width + 0.75);
    const vec2 lower = min(segment.a.xy, segment.b.xy) - margin, upper = max(segment.a.xy, segment.b.xy) + margin;
    if (float(j) + 0.5 < lower.y || float(j) + 0.5 > upper.y) continue;
    row_begin = min(row_begin, s);
    row_end = s + 1u;
    row_columns = vec2(min(row_columns.x, lower.x), max(row_columns.y, upper.x));
  }
}

/// One loop over segments and their pieces, where they are not kept: lavapipe ends an invocation's loops after 65,535
/// rounds of them all.
void walk_own() {
  const bool are_kept = own_pieces <= k_kept_pieces;
  const float column = float(own_texel.x) + 0.5;
  const uint end = are_kept ? own_pieces : column < row_columns.x || column > row_columns.y ? 0u : row_end;
  uint s = are_kept ? 0u : row_begin, i = 0u;
  while (s < end) {
    if (are_kept) {
      visit_own(kept[s]);
      ++s;
    } else {
      const MapSegment segment = map_segment(s);
      const uint pieces = pieces_of(segment, push.pieces_per_step);
      visit_own(piece_of(segment, i, pieces));
      s += i + 1u == pieces ? 1u : 0u;
      i = i + 1u == pieces ? 0u : i + 1u;
    }
  }
}

/// In texels of the map.
MapPlacement own_placement;
vec2 receiver_at;
float distance_across(uint v) {
  return length(place_in_map(own_placement, in_light_axes(texelFetch(vertices, int(v)).xyz)).xy - receiver_at);
}

/// The receiver lies at vertex v, where segment s begins or would, seen from the light at `seen`, in the map at `at`.
void find_own(MapPlacement placement, uint s, uint v, vec3 seen, vec2 at, float disc_radius) {
  const float radius = texelFetch(vertices, int(v)).w * push.caster_width;
  const float half_width = radius * placement.scale.x * view_scale(seen, push.reach);
  own_placement = placement;
  receiver_at = at;
  find_own_segments(s, v, own_reach(disc_radius, half_width), own_slack(half_width));
  own_pieces = 0u;
  for (uint i = own_begin; i < own_end && own_pieces <= k_kept_pieces; ++i) walk_segment(i, push.pieces_per_step);
}
