#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/passes/aovs/aovs.glsl"
layout(std430, binding = 8) readonly buffer SeenSegments { Seen seen[]; };

Seen seen_in(uint pixel) { return seen[pixel]; }

void main() { write_aovs(invocation()); }
