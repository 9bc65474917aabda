// Coverage by area: what a segment covers of a pixel by a formula, whichever part of it that is.
#include "render/passes/tiles/blocks.glsl"

uvec2 turned(uvec2 value) { return value; }
void choose_turn(uint begin, uint end) {}
uint drawings_of_tile() { return 1u; }
void begin_drawing(uint drawing) {}

// Strands lie in a pixel by chance: of what is left each covers its share.
float seen_share(float left, float covered) { return left * covered; }

bool is_full() { return false; }  // something is always let through

// On the block whose first pixel has its middle there.
void draw(Prepared own, vec2 first_pixel) {
  vec4 line = own.axis, size = own.extent, middle = own.shade, change = own.slope;
  float across = line.x * first_pixel.y - line.y * first_pixel.x + line.z;
  float along = line.x * first_pixel.x + line.y * first_pixel.y + line.w, half_length = size.z;
  float longest = min(1.0, 2.0 * half_length);
  [[unroll]] for (int k = 0; k < k_block; ++k) {
    vec2 from_first = vec2(in_block(k));
    float d = across + line.x * from_first.y - line.y * from_first.x;
    float s = along + line.x * from_first.x + line.y * from_first.y;
    float at = clamp(s, -half_length, half_length), inverse_depth = middle.w + at * change.w;
    float half_width = half_width_at(own, s);
    float covered = clamp((half_width + 0.5 - abs(d)) * size.y, 0.0, min(1.0, 2.0 * half_width) * size.y);
    covered *= clamp(half_length + 0.5 - abs(s), 0.0, longest);
    take(k, vertex_at(own, at, inverse_depth), inverse_depth >= scene[k] ? covered : 0.0,
         color_at(own, at, inverse_depth), inverse_depth);
  }
  end_segment();
}
