// The exponent of T in the layers of a texel as it is stored, for the lookups of all texels and of tiles.
#include "cuticle/shadows/deep_opacity/layers.glslh"
#include "cuticle/shadows/map_filter.glsl"
#include "cuticle/shadows/splat.glslh"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer Ranges { uint ranges[]; };
layout(std430, binding = 3) readonly buffer Layers { uint layers[]; };
layout(std430, binding = 4) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 5) readonly buffer Table { uint table[]; };  // deposits, shares, the exponents of codes
layout(std430, binding = 6) writeonly buffer Transmittance { float transmittance[]; };

const uint k_bytes = 4u;  // k_bytes_flag of deep_opacity_gpu.cpp: sums are packed codes

float fibre_exponent;

/// The exponent before the end of layer i % layers of texel i / layers.
float exponent_before(uint i) {
  const bool packed = (push.flags & k_bytes) != 0u;
  const uint word = sums[packed ? i / 4u : i];
  float exponent = push.per_unit * float(word);
  for (bool left = packed; left; left = false)  // a loop is skipped where a condition would be masked
    exponent = uintBitsToFloat(table[k_coverage_steps + 1u + k_most_layers + packed_code(word, i % 4u)]);
  return exponent;
}

float stored_exponent(uint texel, float z) {
  const uint range = ranges[texel];
  const float depth = z - float(range_nearest(range)), extent = depth_extent(range);
  float exponent = 0.0;
  if (range != k_no_range && depth > 0.0) {
    const Layer layer = unpacked_layer(layers[k_layer_table + table_step(uint(depth))]);
    const bool is_behind = depth >= extent;
    const uint i = texel * push.layers + (is_behind ? push.layers - 1u : layer.index);
    const float after = exponent_before(i);
    float before = 0.0;
    if (layer.index > 0u && !is_behind) before = exponent_before(i - 1u);
    exponent = exponent_within(layer, extent, depth, before, after, fibre_exponent);
  }
  return exponent;
}

/// One invocation per vertex: the mean over the filter's disc of T, or of sigma.
void look_up_vertex() {
  const uint v = invocation();
  if (v >= push.count) return;
  fibre_exponent = push.per_unit * float(table[layers[k_most_layers]]);
  transmittance[v] = transmittance_at(placement_of(least), vertices[v].xyz, k_deepest);
}
