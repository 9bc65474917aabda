#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel, which packs words of its number and of every further number of texels: sums become codes of T.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_geometry.glsl"
#include "shadows/splat.glslh"

layout(std430, binding = 0) readonly buffer Table { uint table[]; };  // deposits, shares, exponents, thresholds
layout(std430, binding = 1) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 2) writeonly buffer Codes { uint codes[]; };

const uint k_thresholds = k_coverage_steps + 1u + k_most_layers + 256u;

/// How many of the 255 thresholds, which fall, are not below the sum.
uint code_of(uint sum) {
  uint first = 0u, count = 255u;
  while (count > 0u) {
    const uint half_count = count / 2u;
    const bool not_below = table[k_thresholds + first + half_count] >= sum;
    first = not_below ? first + half_count + 1u : first;
    count = not_below ? count - half_count - 1u : half_count;
  }
  return first;
}

void main() {
  const uint t = invocation();
  if (t >= push.count) return;
  const uint numbers = push.count * push.layers;
  for (uint word = t; word < (numbers + 3u) / 4u; word += push.count) {
    uint bits = 0u;
    for (uint i = 4u * word; i < 4u * word + 4u; ++i)
      bits |= code_of(i < numbers ? sums[i] : 0u) << (8u * (i % 4u));
    codes[word] = bits;
  }
}
