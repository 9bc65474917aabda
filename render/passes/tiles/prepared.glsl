// A segment as the eight invocations of a tile tell it to each other.
layout(local_size_x = 8) in;

const uint k_lanes = 8u;
const int k_block = 8;  // pixels of an invocation, 2 x 4
const uvec2 k_block_size = uvec2(2u, 4u);
const uint k_blocks_across = 4u;

// Where in the tile an invocation's block begins, and its pixel k in that.
uvec2 first_of_block(uint lane) { return k_block_size * uvec2(lane % k_blocks_across, lane / k_blocks_across); }
uvec2 in_block(int k) { return uvec2(k & 1, k >> 1); }

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
