#ifndef CUTICLE_RENDER_LENS_GLSL
#define CUTICLE_RENDER_LENS_GLSL
// The circle of confusion of a thin lens; depth_of_field_gpu.cpp holds the same fields.
#include "render/filter_tile.glsl"

layout(push_constant) uniform Push {
  uvec2 resolution;
  uvec2 tiles;          // of k_tile pixels a side
  float inverse_focus;  // 1 / distance that is sharp
  float lens_pixels;    // radius of the lens times pixels per slope
  float largest;        // radius in pixels that no disc passes
  uint samples;
};

const float k_point = 0.5;  // radius of a disc that is a pixel

/// Radius of the disc that a point at 1 / distance spreads over: seen from the lens's rim instead of its middle, it moves
/// against the plane of focus by the radius of the lens times the difference of the inverse distances.
float blur_radius(float inverse_distance) {
  return clamp(abs(inverse_focus - inverse_distance) * lens_pixels, k_point, largest);
}
#endif
