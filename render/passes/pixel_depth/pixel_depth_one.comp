#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/pixel_depth/pixel_depth.glsl"
layout(binding = 2) uniform sampler2D depth;

float texel_depth(ivec2 texel) { return texelFetch(depth, texel, 0).r; }
