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
layout(std430, binding = 5) writeonly buffer Transmittance { float transmittance[]; };

LayerEnds ends;

float exponent_at(uint texel, float z) {
  if (nearest[texel] == k_no_depth) return 0.0;
  const float depth = z - float(nearest[texel]);
  if (!(depth > 0.0)) return 0.0;
  const uint layer = layer_of(ends, uint(depth));
  const float begin = float(layer_begin(ends, layer)), end = float(ends.end[layer]);
  const uint first = texel * push.layers;
  const float nearer = layer == 0u ? 0.0 : float(sums[first + layer - 1u]);
  return push.per_unit * between_planes(nearer, float(sums[first + layer]), min(1.0, (depth - begin) / (end - begin)));
}

void main() {
  const uint v = invocation();
  if (v >= push.count) return;
  ends.count = push.layers;
  for (uint i = 0u; i < push.layers; ++i) ends.end[i] = ends_of_layers[i];
  transmittance[v] = transmittance_at(placement_of(least), vertices[v].xyz, k_deepest);
}
