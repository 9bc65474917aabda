#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/cull_strands/cull_depth.glsl"
layout(binding = 1) uniform sampler2D depth;

float texel_depth(ivec2 texel) { return texelFetch(depth, texel, 0).r; }
