#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma.
layout(local_size_x = 64) in;
const int k_first_target = 6;
#include "shadows/opacity_map/opacity_planes.glsl"
#include "shadows/opacity_map/ends.glsl"
#define STRAND_LIST_BINDING 5
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 4) writeonly buffer Transmittance { float transmittance[]; };

float known_z = -1.0;  // the depth that the weights are of

void weigh_planes(float z) {
  weights = tent_weights(is_between_ends ? depths_of_ends[0] : z);
  if (!is_between_ends) return;
  const vec4 last[4] = tent_weights(depths_of_ends[1]);
  for (int i = 0; i < 4; ++i) weights[i] = mix(weights[i], last[i], share_of_last);
}

float exponent_at(uint texel, float z) {
  if (z != known_z) weigh_planes(z);
  known_z = z;
  return weighted_exponent(texel);
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v >= push.count) return;
  const MapPlacement placement = placement_of(least);
  find_ends(placement, v);
  transmittance[v] = transmittance_of_vertex(placement, v, push.intervals);
}
