// The exponent of T in the layers of a texel as it is stored, for the lookups of all texels and of tiles.
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_filter.glsl"
#include "shadows/splat.glslh"

layout(binding = 0) uniform samplerBuffer vertices;
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(binding = 2) uniform usamplerBuffer ranges;
layout(binding = 3) uniform usamplerBuffer layers;
layout(binding = 4) uniform usamplerBuffer sums;
layout(binding = 5) uniform usamplerBuffer table;  // deposits, shares, the exponents of codes
layout(std430, binding = 6) writeonly buffer Transmittance { float transmittance[]; };

const uint k_bytes = 4u;  // k_bytes_flag of deep_opacity_gpu.cpp: sums are packed codes

float fibre_exponent;

/// The exponent before the end of layer i % layers of texel i / layers.
float exponent_before(uint i) {
  const bool packed = (push.flags & k_bytes) != 0u;
  const uint word = texelFetch(sums, int(packed ? i / 4u : i)).r;
  float exponent = push.per_unit * float(word);
  for (bool left = packed; left; left = false)  // a loop is skipped where a condition would be masked
    exponent = uintBitsToFloat(texelFetch(table, int(k_coverage_steps + 1u + k_most_layers + packed_code(word, i % 4u))).r);
  return exponent;
}

float stored_exponent(uint texel, float z) {
  const uint range = texelFetch(ranges, int(texel)).r;
  const float depth = z - float(range_nearest(range)), extent = depth_extent(range);
  float exponent = 0.0;
  if (range != k_no_range && depth > 0.0) {
    const Layer layer = unpacked_layer(texelFetch(layers, int(k_layer_table + table_step(uint(depth)))).r);
    const bool is_behind = depth >= extent;
    const uint i = texel * push.layers + (is_behind ? push.layers - 1u : layer.index);
    const float after = exponent_before(i);
    float before = 0.0;
    if (layer.index > 0u && !is_behind) before = exponent_before(i - 1u);
    exponent = exponent_within(layer, extent, depth, before, after, fibre_exponent);
  }
  return exponent;
}

/// At a vertex: the mean over the filter's disc of T, or of sigma.
void look_up(MapPlacement placement, uint v) {
  fibre_exponent = push.per_unit * float(texelFetch(table, int(texelFetch(layers, int(k_most_layers)).r)).r);
  transmittance[v] = transmittance_at(placement, texelFetch(vertices, int(v)).xyz, k_deepest);
}
