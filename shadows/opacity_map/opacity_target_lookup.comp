#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma.
layout(local_size_x = 64) in;
const int k_first_target = 6;
#include "shadows/opacity_map/opacity_planes.glsl"
#define STRAND_LIST_BINDING 5
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 4) writeonly buffer Transmittance { float transmittance[]; };

float known_z = -1.0;  // the depth that the weights are of

float exponent_at(uint texel, float z) {
  if (z != known_z) weights = tent_weights(z);
  known_z = z;
  return weighted_exponent(texel);
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v < push.count) transmittance[v] = transmittance_of_vertex(placement_of(least), v, push.intervals);
}
