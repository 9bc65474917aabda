// Fine rasteriser: blends each tile's segments from near to far, as they were sorted, with pixels in registers.
#include "cuticle/render/passes/tiles/columns.glsl"

bool set_aside(float least, float most) { return false; }

void take(int row, uint vertex, float covered, vec3 color, float inverse_depth) {
  float weight = through[row] * covered;
  light[row] += weight * color;
  depth[row] += weight * inverse_depth;
  through[row] -= weight;
  if (k_says_seen != 0u) {
    samples[row] += weight > 0.0 ? 1u : 0u;
    seen_vertex[row] = weight > most_seen[row] ? vertex : seen_vertex[row];
    most_seen[row] = max(most_seen[row], weight);
  }
}

void main() {
  uint lane = own_lane(), tile = tile_of_group();
  uint begin = min(offsets[tile], push.capacity), end = min(offsets[tile + 1u], push.capacity);
  uvec2 corner = corner_of(tile);
  begin_column(lane, corner);
  for (uint first = begin; first < end; first += k_lanes) {
    draw_eight(lane, first, end, corner);
    looked_at += min(k_lanes, end - first);
    if (is_closed()) break;
  }
  end_column(lane, corner);
}
