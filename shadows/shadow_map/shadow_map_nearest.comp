#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: the nearest depth step of every texel whose centre it holds, if opaque, or that it covers
// in part, if hair absorbs along its depth.
layout(local_size_x = 64) in;
#include "shadows/map_splat.glsl"
#include "shadows/shadow_map/depth.glslh"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) buffer Nearest { uint nearest[]; };

const uint k_opaque = 2u;  // k_opaque_flag of shadow_map_gpu.cpp
uint vertex;

void deposit(uint texel, uint covered, uint depth_step) {
  const bool counts = (push.flags & k_opaque) == 0u ||
                      is_at_centre && is_drawn(vertex, texel, table[k_coverage_steps + 1u]);
  if (counts) atomicMin(nearest[texel], depth_step);
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  vertex = first_vertex(s);
  walk_segment(s, push.pieces_per_step);
}
