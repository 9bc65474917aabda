#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: the nearest depth step of every texel it covers.
layout(local_size_x = 64) in;
#include "cuticle/shadows/deep_opacity/layers.glslh"
#include "cuticle/shadows/map_splat.glsl"

layout(std430, binding = 3) buffer Nearest { uint nearest[]; };

void deposit(Footprint footprint, int i, int j) {
  const vec2 offset = texel_offset(footprint.from, i, j);
  if (coverage_index(coverage(footprint, offset)) > 0u)
    atomicMin(nearest[uint(j) * push.resolution + uint(i)], uint(max(0, depth_bin(footprint, offset))));
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, k_pieces_per_step);
}
