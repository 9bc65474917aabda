#ifndef CUTICLE_RENDER_SHUTTER_GLSL
#define CUTICLE_RENDER_SHUTTER_GLSL
// What a pixel moves by while the shutter is open; motion_blur_gpu.cpp holds the same fields.
#include "render/filter_tile.glsl"

layout(push_constant) uniform Push {
  uvec2 resolution;
  uvec2 tiles;        // of k_tile pixels a side
  float half_shutter;  // frames
  float largest;      // pixels that no motion passes
  uint samples;
};

/// From the middle of the shutter to its end, pixels, from the motion since the frame before.
vec2 half_way(vec2 motion) {
  const vec2 way = half_shutter * motion;
  return way * min(1.0, largest / max(length(way), 1e-6));
}
#endif
