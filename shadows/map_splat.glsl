// Walks the texels that a strand segment covers in part. The shader that includes this defines deposit(), called for each.
#include "shadows/map_segments.glsl"

/// `covered`: index into the table of deposits, above 0.
void deposit(uint texel, uint covered, uint depth_step);
bool is_at_centre;  // of the texel that deposit() is called for: the segment's footprint holds it

void deposit_at(Footprint footprint, int i, int j) {
  const vec2 offset = texel_offset(footprint.from, i, j);
  is_at_centre = holds_point(footprint, offset);
  const uint covered = coverage_index(coverage(footprint, offset));
  if (covered > 0u) deposit(uint(j) * columns + uint(i), covered, uint(max(0, depth_bin(footprint, offset))));
}

/// The texels of a row, or of a column where that is the minor axis, that the footprint may reach.
ivec2 minor_reach(Footprint footprint, Reach reach, int m, int minor_end) {
  return ivec2(max(0, minor_bound(footprint, reach, m, -1.0)), min(minor_end, minor_bound(footprint, reach, m, 1.0)));
}

/// One loop over both axes: neighbouring invocations then wait for the longest of their footprints, not for the longest
/// of every row.
void piece(Footprint footprint) {
  const Reach reach = footprint_reach(footprint);
  const int last_row = int(rows) - 1, last_column = int(columns) - 1;
  const int major_end = reach.steep ? last_row : last_column, minor_end = reach.steep ? last_column : last_row;
  const int last = min(major_end, reach.last);
  int m = max(0, reach.first);
  ivec2 across = minor_reach(footprint, reach, m, minor_end);
  do {
    const int n = across.x;
    if (n <= across.y && m <= last) deposit_at(footprint, reach.steep ? n : m, reach.steep ? m : n);
    across.x = n + 1;
    if (n >= across.y) across = minor_reach(footprint, reach, ++m, minor_end);
  } while (m <= last);
}
