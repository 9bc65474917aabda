#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the layers behind each texel's nearest fibre, by integer sums.
layout(local_size_x = 64) in;
#include "cuticle/shadows/deep_opacity/layers.glslh"
#include "cuticle/shadows/map_splat.glsl"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, binding = 4) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 5) readonly buffer Layers { uint layers[]; };
layout(std430, binding = 6) buffer Sums { uint sums[]; };

void deposit(uint texel, uint covered, uint depth_step) {
  const uint layer = unpacked_layer(layers[k_layer_table + table_step(depth_step - depths[2u * texel])]).index;
  atomicAdd(sums[texel * push.layers + layer], table[covered]);
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
