#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, within the layers of each texel.
layout(local_size_x = 64) in;
#include "cuticle/shadows/deep_opacity/layers.glslh"
#include "cuticle/shadows/map_filter.glsl"
#include "cuticle/shadows/splat.glslh"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 3) readonly buffer Ends { uint ends_of_layers[]; };
layout(std430, binding = 4) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 5) readonly buffer Table { uint table[]; };  // deposits, shares, the exponents of codes
layout(std430, binding = 6) writeonly buffer Transmittance { float transmittance[]; };

const uint k_bytes = 4u;  // k_bytes_flag of deep_opacity_gpu.cpp: nearest depths and sums are packed

LayerEnds ends;

uint nearest_of(uint texel) {
  return (push.flags & k_bytes) != 0u ? packed_depth(nearest[texel / 2u], texel % 2u) : nearest[texel];
}

/// The exponent before the end of layer i % layers of texel i / layers.
float exponent_before(uint i) {
  if ((push.flags & k_bytes) == 0u) return push.per_unit * float(sums[i]);
  return uintBitsToFloat(table[k_coverage_steps + 1u + k_most_layers + packed_code(sums[i / 4u], i % 4u)]);
}

float exponent_at(uint texel, float z) {
  const uint front = nearest_of(texel);
  if (front == k_no_depth) return 0.0;
  const float depth = z - float(front);
  if (!(depth > 0.0)) return 0.0;
  const uint layer = layer_of(ends, uint(depth));
  const float begin = float(layer_begin(ends, layer)), end = float(ends.end[layer]);
  const uint first = texel * push.layers;
  const float nearer = layer == 0u ? 0.0 : exponent_before(first + layer - 1u);
  return between_planes(nearer, exponent_before(first + layer), min(1.0, (depth - begin) / (end - begin)));
}

void main() {
  const uint v = invocation();
  if (v >= push.count) return;
  ends.count = push.layers;
  for (uint i = 0u; i < push.layers; ++i) ends.end[i] = ends_of_layers[i];
  transmittance[v] = transmittance_at(placement_of(least), vertices[v].xyz, k_deepest);
}
