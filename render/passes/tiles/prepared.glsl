// A segment as the eight invocations of a tile tell it to each other.
layout(local_size_x = 8) in;

const uint k_lanes = 8u;
const int k_block = 8;  // pixels of an invocation, 2 x 4
const uint k_blocks_across = 4u;

// Of areas.glsl or spans.glsl: with x and y exchanged where the tile is drawn so; whether it is, from its segments.
uvec2 turned(uvec2 value);
void choose_turn(uint begin, uint end);
void empty_spans();  // nothing of the block is covered
float seen_share(float left, float covered);  // of a pixel, of which so much lets through and a segment covers so much

// Pixels of a block each way, where in the tile an invocation's block begins, and its pixel k in that.
uvec2 block_size() { return turned(uvec2(2u, 4u)); }
uvec2 first_of_block(uint lane) {
  return turned(uvec2(2u, 4u) * uvec2(lane % k_blocks_across, lane / k_blocks_across));
}
uvec2 in_block(int k) { return turned(uvec2(k & 1, k >> 1)); }

// The axis: pixel q lies cross(xy, q) + z across it and dot(xy, q) + w along it. Extents and limits of the coverage
// across and along. Colour and 1 / depth at the middle of the axis, and how they change per pixel.
struct Prepared {
  vec4 axis, extent, shade, slope;
  uint vertex;  // the first
};

// Of blocks.glsl: the first vertex of an entry of the tile's list; an entry as the tile draws it, unseen from `end` on.
uint vertex_of(uint entry);
Prepared set_up(uint entry, uint end, vec2 tile_middle);

// Draws it on the block whose first pixel has its middle there.
void draw(Prepared own, vec2 first_pixel);
