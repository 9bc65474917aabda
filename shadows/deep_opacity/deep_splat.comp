#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: deposits into the layers behind each texel's nearest fibre, by integer sums.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_splat.glsl"

layout(binding = 3) uniform usamplerBuffer table;
layout(binding = 4) uniform usamplerBuffer depths;
layout(binding = 5) uniform usamplerBuffer layers;
layout(std430, binding = 6) buffer Sums { uint sums[]; };

void deposit(uint texel, uint covered, uint depth_step) {
  if (!is_kept(texel)) return;
  const uint nearest = texelFetch(depths, int(2u * texel)).r;
  const uint extent = found_extent(nearest, texelFetch(depths, int(2u * texel) + 1).r);
  const uint behind = table_step(layer_step(depth_step - nearest, extent, (push.flags & k_by_texel_flag) != 0u));
  const uint layer = unpacked_layer(texelFetch(layers, int(k_layer_table + behind)).r).index;
  atomicAdd(sums[kept_place(texel) * push.layers + layer], texelFetch(table, int(covered)).r);
}

void main() {
  const uint s = invocation();
  if (s < push.count) walk_segment(s, push.pieces_per_step);
}
