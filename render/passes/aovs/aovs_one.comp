#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/aovs/aovs_samples.glsl"
layout(binding = 8) uniform usampler2D seen;

uint segment_at(ivec2 texel, int sample_index) { return texelFetch(seen, texel, 0).r; }

void main() { write_aovs(invocation()); }
