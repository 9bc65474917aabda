// The invocations of a tile, which pixels each has, and a segment as they tell it to each other. Eight have a block of 2 x 4
// pixels each; where there are more, so many share a block, that one has half a row of it (32) or a pixel (64).
layout(local_size_x_id = 2) in;
layout(constant_id = 2) const uint k_lanes = 8u;  // a tile's invocations: 8, 32 or 64

const int k_block = 64 / int(k_lanes);  // pixels of an invocation
const uint k_sharers = k_lanes / 8u;    // invocations of a block
const uint k_blocks_across = 4u;

uint own_lane();  // of exchange_records.glsl or exchange_shared.glsl

// Of areas.glsl or spans.glsl: with x and y exchanged where the tile is drawn so; whether it is, from its segments.
uvec2 turned(uvec2 value);
void choose_turn(uint begin, uint end);
uint drawings_of_tile();  // how many times it is drawn; its picture is the mean
void begin_drawing(uint drawing);  // nothing of the block is covered
float seen_share(float left, float covered);  // of a pixel, of which so much lets through and a segment covers so much
bool is_full();  // nothing more can be seen on the invocation's pixels

// Pixels of a block each way, where in the tile a block begins, and which of its pixels is the invocation's own k.
uvec2 block_size() { return turned(uvec2(2u, 4u)); }
uvec2 first_of_block(uint block) {
  return turned(uvec2(2u, 4u) * uvec2(block % k_blocks_across, block / k_blocks_across));
}
int pixel_of(int k) { return int(own_lane() % k_sharers) * k_block + k; }
uvec2 in_block(int k) { return turned(uvec2(pixel_of(k) & 1, pixel_of(k) >> 1)); }

// The axis: pixel q lies cross(xy, q) + z across it and dot(xy, q) + w along it. Extent: half width at the middle of the
// axis, opacity (0: not to be drawn), half length, and how the half width changes per pixel. Colour (or parts_of of
// part_colors.glsl) and 1 / depth at the middle of the axis, and how they change per pixel.
struct Prepared {
  vec4 axis, extent, shade, slope;
  uint vertex;  // the first
};

// Half width in the middle of what a pixel may hold of the segment, whose middle lies so far along it.
float half_width_at(Prepared own, float along) {
  vec2 held = clamp(vec2(along - 0.5, along + 0.5), -own.extent.z, own.extent.z);
  return own.extent.x + own.extent.w * 0.5 * (held.x + held.y);
}

// Of blocks.glsl: the first vertex of an entry of the tile's list; an entry as the tile draws it, unseen from `end` on.
uint vertex_of(uint entry);
Prepared set_up(uint entry, uint end, vec2 tile_middle);

// Draws it on the block whose first pixel has its middle there.
void draw(Prepared own, vec2 first_pixel);
