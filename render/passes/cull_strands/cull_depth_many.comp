#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/cull_strands/cull_depth.glsl"
layout(constant_id = 0) const int k_samples = 1;
layout(binding = 1) uniform sampler2DMS depth;

float texel_depth(ivec2 texel) {
  float farthest = 0.0;
  for (int k = 0; k < k_samples; ++k) farthest = max(farthest, texelFetch(depth, texel, k).r);
  return farthest;
}
