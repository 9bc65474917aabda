#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of the light behind each texel's nearest fibre.
layout(local_size_x = 64) in;
#include "shadows/map_filter.glsl"
#include "shadows/shadow_map/depth.glslh"
#include "shadows/splat.glslh"
#define STRAND_LIST_BINDING 6
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 5) writeonly buffer Transmittance { float transmittance[]; };

const uint k_opaque = 2u;  // k_opaque_flag of shadow_map_gpu.cpp
float steps_per_metre, crossing;

uint own_nearest;

void own_deposit(uint covered, uint depth_step) {
  const bool counts = own_is_at_centre || (push.flags & k_opaque) == 0u;
  own_nearest = min(own_nearest, counts ? depth_step : k_no_depth);
}

float exponent_at(uint texel, float z) {
  own_nearest = k_no_depth;
  walk_own();
  if (nearest[texel] >= own_nearest) return 0.0;
  const float behind = steps_behind(z, nearest[texel], push.own[0], steps_per_metre);
  return -depth_behind(behind, (push.flags & k_opaque) != 0u, crossing, push.own[1] * steps_per_metre);
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v >= push.count) return;
  const MapPlacement placement = placement_of(least);
  steps_per_metre = placement.scale.z;
  crossing = -push.per_unit * float(table[k_coverage_steps]);
  transmittance[v] = transmittance_of_vertex(placement, v, k_deepest);
}
