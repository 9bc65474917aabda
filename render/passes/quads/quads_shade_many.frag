#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/quads/quads_shade.glsl"
layout(set = 0, binding = 10) uniform usampler2DMS seen;

uint segment_at(ivec2 pixel, int sample_index) { return texelFetch(seen, pixel, sample_index).r; }

void main() { shade_pixel(ivec2(gl_FragCoord.xy), vec2(textureSize(seen))); }
