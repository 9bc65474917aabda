#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/aovs/aovs_samples.glsl"
layout(binding = 8) uniform usampler2DMS seen;

uint segment_at(ivec2 texel, int sample_index) { return texelFetch(seen, texel, sample_index).r; }

void main() { write_aovs(invocation()); }
