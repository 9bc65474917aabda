#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/pixel_depth/pixel_depth.glsl"
layout(constant_id = 0) const int k_samples = 1;
layout(binding = 2) uniform sampler2DMS depth;

float texel_depth(ivec2 texel) {
  float nearest = 1.0;
  for (int k = 0; k < k_samples; ++k) nearest = min(nearest, texelFetch(depth, texel, k).r);
  return nearest;
}
