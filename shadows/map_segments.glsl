// Walks the pieces of a strand segment. The shader that includes this defines piece(), which is called for each.
#include "shadows/map_segment.glsl"

void piece(Footprint footprint);

/// Segment s in pieces at most 1 / steps_to_pieces depth steps deep. Loops here end at their last line: on lavapipe one
/// that asks first runs its body once more, masked.
void walk_segment(uint s, float steps_to_pieces) {
  const MapSegment segment = map_segment(s, push.count);
  const vec3 a = segment.a, b = segment.b;
  const float size = segment_footprint(a, b, segment.half_width, 0.0, 0.0).size;
  const uint pieces = piece_count(a.z * steps_to_pieces, b.z * steps_to_pieces, size);
  uint i = 0u;
  do {
    piece(segment_footprint(piece_point(a, b, i, pieces), piece_point(a, b, i + 1u, pieces), segment.half_width,
                            segment.is_first && i == 0u ? 1.0 : 0.0, segment.is_last && i + 1u == pieces ? 1.0 : 0.0));
  } while (++i < pieces);
}
