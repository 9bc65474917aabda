#ifndef CUTICLE_RENDER_FILTER_TILE_GLSL
#define CUTICLE_RENDER_FILTER_TILE_GLSL
const uint k_tile = 16u;  // pixels a side; tiled_filter_gpu.cpp holds the same
#endif
