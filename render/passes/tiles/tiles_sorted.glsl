// Fine rasteriser: blends each tile's segments from near to far, as they were sorted, with pixels in registers.

bool depth_culled(float least, float most) { return false; }

float drawing_share = 1.0;  // of the tile's picture, that a drawing is
float transmittance_before[k_block];

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
  float of_drawing = seen_share(transmittance[k], covered), weight = of_drawing * drawing_share;
  light[k] += weight * color;
  depth[k] += weight * inverse_depth;
  transmittance[k] -= of_drawing;
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

// The picture is the mean of a tile's drawings, each of which begins where all is let through.
void next_drawing() {
  [[unroll]] for (int k = 0; k < k_block; ++k) {
    transmittance_before[k] += transmittance[k];
    transmittance[k] = 1.0;
  }
}
void end_drawings() {
  [[unroll]] for (int k = 0; k < k_block; ++k) {
    transmittance[k] = drawing_share * (transmittance[k] + transmittance_before[k]);
    samples[k] = uint(drawing_share * float(samples[k]) + 0.75);
  }
}

void draw_tile(uint begin, uint end, vec2 first_middle, vec2 tile_corner) {
  uint first = begin;
  do {
    draw_chunk(first, end, first_middle, tile_corner);
    looked_at += min(k_chunk, end - first);
    first += k_chunk;
  } while (first < end && !is_closed());
}

void main() {
  uint tile = tile_of_group();
  uint begin = min(offsets[tile], push.capacity), end = min(offsets[tile + 1u], push.capacity);
  if (begin == end) return;  // the picture was emptied
  choose_turn(begin, end);
  uvec2 corner = corner_of(tile), block = block_of(own_lane(), corner);
  begin_block(block);
  begin_shares(block);
  [[unroll]] for (int k = 0; k < k_block; ++k) transmittance_before[k] = 0.0;
  uint drawing = 0u, count = drawings_of_tile();
  drawing_share = 1.0 / float(count);
  do {
    if (drawing > 0u) next_drawing();
    begin_drawing(drawing);
    draw_tile(begin, end, vec2(block + first_pixel()) + 0.5, vec2(corner + first_pixel()));
  } while (++drawing < count);
  if (count > 1u) end_drawings();
  end_picture(block);
}
