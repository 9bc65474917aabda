// Walks the pieces of a strand segment. The shader that includes this defines piece(), which is called for each.
#include "shadows/map_segment.glsl"

void piece(Footprint footprint);

/// Pieces of a segment, at most 1 / steps_to_pieces depth steps deep, and piece i of them.
uint pieces_of(MapSegment segment, float steps_to_pieces) {
  const float size = segment_footprint(segment.a, segment.b, segment.half_width, 0.0, 0.0).size;
  return piece_count(segment.a.z * steps_to_pieces, segment.b.z * steps_to_pieces, size);
}
Footprint piece_of(MapSegment segment, uint i, uint pieces) {
  return segment_footprint(piece_point(segment.a, segment.b, i, pieces),
                           piece_point(segment.a, segment.b, i + 1u, pieces), segment.half_width,
                           segment.is_first && i == 0u ? 1.0 : 0.0, segment.is_last && i + 1u == pieces ? 1.0 : 0.0);
}

/// All pieces of a segment. Loops here end at their last line: on lavapipe one that asks first runs its body once more,
/// masked.
void walk_pieces(MapSegment segment, float steps_to_pieces) {
  const uint pieces = pieces_of(segment, steps_to_pieces);
  uint i = 0u;
  do {
    piece(piece_of(segment, i, pieces));
  } while (++i < pieces);
}
void walk_segment(uint s, float steps_to_pieces) { walk_pieces(map_segment(s), steps_to_pieces); }
