#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the layers behind each texel's nearest fibre, by integer sums.
layout(local_size_x = 64) in;
#include "cuticle/shadows/deep_opacity/layers.glslh"
#include "cuticle/shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 5) readonly buffer Ends { uint ends_of_layers[]; };
layout(std430, binding = 6) buffer Sums { uint sums[]; };

LayerEnds ends;

void deposit(Footprint footprint, int i, int j) {
  const vec2 offset = texel_offset(footprint.from, i, j);
  const uint amount = table[coverage_index(coverage(footprint, offset))];
  if (amount == 0u) return;
  const uint texel = uint(j) * push.resolution + uint(i);
  const uint layer = layer_of(ends, uint(max(0, depth_bin(footprint, offset))) - nearest[texel]);
  atomicAdd(sums[texel * push.layers + layer], amount);
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  ends.count = push.layers;
  for (uint i = 0u; i < push.layers; ++i) ends.end[i] = ends_of_layers[i];
  walk_segment(s, k_pieces_per_step);
}
