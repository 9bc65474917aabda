// A segment as the eight invocations of a tile tell it to each other.
layout(local_size_x = 8) in;

const uint k_lanes = 8u;

// The axis: pixel q lies cross(xy, q) + z across it and dot(xy, q) + w along it. Extents and limits of the coverage
// across and along. Colour and 1 / depth at the middle of the axis, and how they change per pixel.
struct Prepared {
  vec4 axis, extent, shade, slope;
  uint vertex;  // the first
};

// Of columns.glsl: the first vertex of an entry of the tile's list; an entry as the tile draws it, unseen from `end` on.
uint vertex_of(uint entry);
Prepared set_up(uint entry, uint end, vec2 tile_middle);
