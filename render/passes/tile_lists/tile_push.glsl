#ifndef CUTICLE_RENDER_TILE_PUSH_GLSL
#define CUTICLE_RENDER_TILE_PUSH_GLSL
// Push constants of the tile kernels (TilePush of tile_lists_gpu.h, word for word).
layout(push_constant) uniform Push {
  mat4 world_to_clip;
  uvec2 resolution, part;  // pixels of the picture, and of what is drawn of it
  uint segment_count, vertices_per_strand;
  uint capacity;       // entries of the lists
  uint supersampling;  // texels of the scene's depth across a pixel; 0: no scene was drawn
  float pixel_scale;   // half a width in pixels = radius * this / depth
  float inverse_near, inverse_far;
  float tip_variation;
  float kept_share;    // of the strands: below 1 only where the lists would pass their budget
  float opacity;
  uint slices;         // of a tile's depth, within which nothing is sorted; 0: segments are sorted
  uint corner;         // of that part, tiles: x in the lower half
} push;

const int k_tile = 8;  // pixels each way

// Tiles of the part, and where in the picture it begins.
uvec2 tile_grid() { return (push.part + uint(k_tile) - 1u) / uint(k_tile); }
uvec2 first_tile() { return uvec2(push.corner & 0xffffu, push.corner >> 16); }
uvec2 first_pixel() { return first_tile() * uint(k_tile); }
#endif
