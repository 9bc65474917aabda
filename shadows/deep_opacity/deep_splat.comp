#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the layers behind each texel's nearest fibre, by integer sums.
layout(local_size_x = 64) in;
#include "cuticle/shadows/deep_opacity/layers.glslh"
#include "cuticle/shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 5) readonly buffer Ends { uint ends_of_layers[]; };
layout(std430, binding = 6) buffer Sums { uint sums[]; };

LayerEnds ends;

void deposit(uint texel, uint covered, uint depth_step) {
  const uint layer = layer_at(ends, depth_step - depths[2u * texel]).index;
  atomicAdd(sums[texel * push.layers + layer], table[covered]);
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  ends.count = push.layers;
  for (uint i = 0u; i < k_most_layers; ++i) ends.end[i] = ends_of_layers[i];
  walk_segment(s, push.pieces_per_step);
}
