#ifndef CUTICLE_RENDER_PICTURE_FILTER_GLSL
#define CUTICLE_RENDER_PICTURE_FILTER_GLSL
// What the kernels of PictureFilter (picture_filter_gpu.h) have in common; the shader binds `picture` and declares
// `resolution` in its push constants.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "core/shared/disc.glslh"
#include "gpu/groups.glsl"

layout(std430, binding = 0) readonly buffer PixelDepth { float pixel_depth[]; };  // 1 / distance; 0: nothing seen
layout(std430, binding = 1) writeonly buffer Filtered { vec4 filtered[]; };

/// A turn of its own for each pixel, so that few points leave grain in place of rings.
float turn_of(uint pixel) {
  uint bits = pixel * 747796405u + 2891336453u;
  bits = ((bits >> ((bits >> 28u) + 4u)) ^ bits) * 277803737u;
  return 6.2831853 * float((bits >> 22u) ^ bits) / 4294967296.0;
}

/// The pixel that a place on the screen lies in; beyond the edge the last.
ivec2 pixel_at(vec2 place, uvec2 resolution) { return clamp(ivec2(floor(place)), ivec2(0), ivec2(resolution) - 1); }
uint index_of(ivec2 pixel, uvec2 resolution) { return uint(pixel.y) * resolution.x + uint(pixel.x); }
#endif
