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

void deposit(uint texel, uint covered, uint depth_step) {
  const uint layer = layer_of(ends, depth_step - nearest[texel]);
  atomicAdd(sums[texel * push.layers + layer], table[covered]);
}

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  ends.count = push.layers;
  for (uint i = 0u; i < push.layers; ++i) ends.end[i] = ends_of_layers[i];
  walk_segment(s, push.pieces_per_step);
}
