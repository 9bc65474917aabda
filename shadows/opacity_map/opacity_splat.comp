#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the intervals between slices by integer sums.
layout(local_size_x = 64) in;
#include "cuticle/shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) buffer Sums { uint sums[]; };

void deposit(Footprint footprint, int i, int j) {
  const vec2 offset = texel_offset(footprint.from, i, j);
  const uint amount = table[coverage_index(coverage(footprint, offset))];
  const int bin = max(0, depth_bin(footprint, offset));
  if (amount == 0u || bin >= int(push.layers)) return;
  atomicAdd(sums[(uint(j) * push.resolution + uint(i)) * push.layers + uint(bin)], amount);
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, 1.0);
}
