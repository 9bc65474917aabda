#version 460
#extension GL_GOOGLE_include_directive : require
// Looks vertices up in a map of all texels.
layout(local_size_x = 64) in;
#include "cuticle/shadows/deep_opacity/deep_exponent.glsl"

float exponent_at(uint texel, float z) { return stored_exponent(texel, z); }

void main() { look_up_vertex(); }
