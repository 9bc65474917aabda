// Fine rasteriser: blends each tile's segments from near to far, as they were sorted, with pixels in registers.

bool depth_culled(float least, float most) { return false; }

#ifdef MARKS_SEEN
#include "render/passes/tiles/seen_marks.glsl"
void begin_shares(uvec2 block) {}
#else
#ifdef TELLS_STRANDS
#include "render/passes/tiles/seen_shares.glsl"
#else
void begin_shares(uvec2 block) {}
void tell_share(int k, uint vertex, float weight, vec3 color, float inverse_depth) {}
#endif

void take(int k, uint vertex, float covered, vec3 color, float inverse_depth) {
  float weight = seen_share(transmittance[k], covered);
  light[k] += weight * color;
  depth[k] += weight * inverse_depth;
  transmittance[k] -= weight;
  tell_share(k, vertex, weight, color, inverse_depth);
  if (k_says_seen != 0u) {
    samples[k] += weight > 0.0 ? 1u : 0u;
    seen_vertex[k] = weight > most_seen[k] ? vertex : seen_vertex[k];
    most_seen[k] = max(most_seen[k], weight);
  }
}

void end_segment() {}
void end_picture(uvec2 block) { end_block(block); }
#endif

void main() {
  uint tile = tile_of_group();
  uint begin = min(offsets[tile], push.capacity), end = min(offsets[tile + 1u], push.capacity);
  if (begin == end) return;  // the picture was emptied
  choose_turn(begin, end);
  uvec2 corner = corner_of(tile), block = block_of(own_lane(), corner);
  begin_block(block);
  begin_shares(block);
  uint first = begin;
  do {
    draw_chunk(first, end, vec2(block + first_pixel()) + 0.5, vec2(corner + first_pixel()));
    looked_at += min(k_chunk, end - first);
    first += k_chunk;
  } while (first < end && !is_closed());
  end_picture(block);
}
