#version 460
#extension GL_GOOGLE_include_directive : require
// N19: T at a point of a segment, by the weights of its own depth or by those that the rasteriser made of the ends'.
#define MAP_IS_DRAWN
const int k_first_target = 4;
#include "shadows/opacity_map/opacity_planes.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 weights_of_vertex[4];
layout(location = 5) flat in uint segment;
layout(location = 0) out float transmittance;

const uint k_vertex_weights = 2u;  // k_vertex_weights_flag of opacity_map_gpu.cpp
float known_z = -1.0;              // the depth that the weights are of

float exponent_at(uint texel, float z) {
  if (z != known_z) weights = (push.flags & k_vertex_weights) != 0u ? weights_of_vertex : tent_weights(z);
  known_z = z;
  return weighted_exponent(texel);
}

void main() {
  transmittance = transmittance_at(placement_of(least), position, segment, first_vertex(segment), push.intervals);
}
