// What a receiver's own fibre has left in the texels of its lookup: the pieces of the segments around it, whose deposits
// are found again by the arithmetic that made them. The shader that includes this defines own_deposit().
#include "shadows/map_segments.glsl"
#include "shadows/own_segments.glsl"

/// Called by walk_own() for every deposit in the texel.
void own_deposit(uint covered, uint depth_step);
bool own_is_at_centre;  // of that texel: the own fibre holds it

// Pieces that may lie in a lookup's disc, in registers, always read by constant numbers; those of lookups with more are
// made again for every texel.
const uint k_kept_pieces = 3u;
Footprint kept_pieces[k_kept_pieces];
uint own_pieces = 0u;
ivec2 own_texel;
vec2 receiver_at;    // in texels of the map
float disc_reached;  // texels from there within which lie the centres of all that a lookup averages

/// Whether a footprint may cover a texel of the lookup's disc.
bool may_reach_disc(Footprint footprint) {
  const vec2 offset = receiver_at - footprint.from;
  const float across = abs(exact_cross(footprint.direction, offset)), along = exact_dot(footprint.direction, offset);
  return across <= footprint.half_width + disc_reached && along >= footprint.start - disc_reached &&
         along <= footprint.end + disc_reached;
}

/// Keeps a piece as long as there is room.
void piece(Footprint footprint) {
  if (!may_reach_disc(footprint)) return;
  if (own_pieces == 0u) kept_pieces[0] = footprint;
  if (own_pieces == 1u) kept_pieces[1] = footprint;
  if (own_pieces == 2u) kept_pieces[2] = footprint;
  ++own_pieces;
}

bool are_kept;  // whether walk_own() visits the kept pieces, or makes all of them again

void visit_own(Footprint footprint) {
  const vec2 offset = texel_offset(footprint.from, own_texel.x, own_texel.y);
  const uint covered = coverage_index(coverage(footprint, offset));
  own_is_at_centre = holds_point(footprint, offset);
  if (covered > 0u) own_deposit(covered, uint(max(0, depth_bin(footprint, offset))));
}

/// Of segments that are not kept: those that may cover a row of texels, and the columns where they may.
uint row_begin, row_end;
vec2 row_columns;
void enter_unkept_row(int j) {
  row_begin = own_end;
  row_end = own_begin;
  row_columns = vec2(3e38, -3e38);
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

void enter_own_row(int j) {
  if (!are_kept) enter_unkept_row(j);
}

/// One loop over segments and their pieces, where they are not kept: lavapipe ends an invocation's loops after 65,535
/// rounds of them all.
void walk_unkept() {
  const float column = float(own_texel.x) + 0.5;
  const uint end = column < row_columns.x || column > row_columns.y ? 0u : row_end;
  uint s = row_begin, i = 0u;
  while (s < end) {
    const MapSegment segment = map_segment(s);
    const uint pieces = pieces_of(segment, push.pieces_per_step);
    visit_own(piece_of(segment, i, pieces));
    s += i + 1u == pieces ? 1u : 0u;
    i = i + 1u == pieces ? 0u : i + 1u;
  }
}

/// Pieces that are not there cover nothing.
void walk_own() {
  if (!are_kept) {
    walk_unkept();
  } else {
    if (own_pieces > 0u) visit_own(kept_pieces[0]);
    if (own_pieces > 1u) visit_own(kept_pieces[1]);
    if (own_pieces > 2u) visit_own(kept_pieces[2]);
  }
}

/// In texels of the map.
MapPlacement own_placement;
MapVertex vertex_now, vertex_before, vertex_first;
void return_to_own_vertex() { vertex_now = vertex_first; }
float visit_own_vertex(uint v) {
  vertex_before = vertex_now;
  vertex_now = map_vertex(v);
  return length(place_in_map(own_placement, vertex_now.seen).xy - receiver_at);
}

/// The pieces of a segment that may lie in the disc.
void walk_near_pieces(MapSegment segment) {
  const uint pieces = pieces_of(segment, push.pieces_per_step);
  const vec2 along = segment.b.xy - segment.a.xy;
  const float inverse_square = 1.0 / max(dot(along, along), 1e-12);
  const float share = dot(receiver_at - segment.a.xy, along) * inverse_square;
  const float away = (disc_reached + 2.0 * segment.half_width) * sqrt(inverse_square);
  uint i = uint(exact_clamp((share - away) * float(pieces), 0.0, float(pieces - 1u)));
  const uint last = uint(exact_clamp((share + away) * float(pieces), 0.0, float(pieces - 1u)));
  do {
    piece(piece_of(segment, i, pieces));
  } while (++i <= last);
}

void visit_own_segment(uint s, bool backward, bool is_first, bool is_last) {
  const MapVertex first = backward ? vertex_now : vertex_before, last = backward ? vertex_before : vertex_now;
  const MapSegment segment = segment_between(own_placement, first, last, is_first, is_last);
  if (own_pieces <= k_kept_pieces) walk_near_pieces(segment);
}

/// The receiver lies at vertex v, where segment s begins or would, seen from the light at `seen`, in the map at `at`.
void find_own(MapPlacement placement, uint s, uint v, vec3 seen, vec2 at, float disc_radius) {
  const float radius = drawn_vertex(v).w * push.caster_width;
  const float half_width = radius * placement.scale.x * view_scale(seen, push.reach);
  own_placement = placement;
  receiver_at = at;
  disc_reached = max(disc_radius, 0.25) + 1.01;
  own_pieces = 0u;
  vertex_first = map_vertex(v);
  find_own_segments(s, v, own_reach(disc_radius, half_width), own_slack(half_width));
}
