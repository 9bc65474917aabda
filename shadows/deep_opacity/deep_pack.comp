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
layout(std430, binding = 3) readonly buffer Box { uint least[6]; };

const uint k_thresholds = k_coverage_steps + 1u + k_max_layers + 256u;

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
  // Numbers of the map from `first` to `end`; `sums` holds those from `held` to `held_end`, since words may begin with
  // numbers of the strip before.
  uint first = 0u, end = push.count * push.layers, held = 0u, held_end = end;
  for (bool in_strips = strip_count() > 1u; in_strips; in_strips = false) {
    placement_of(least);
    first = own_first_row * columns * push.layers;
    end = own_end_row * columns * push.layers;
    held = first_kept * push.layers;
    held_end = end_kept * push.layers;
  }
  for (uint word = first / 4u + t; word < (end + 3u) / 4u; word += push.count) {
    uint bits = 0u;
    for (uint i = 4u * word; i < 4u * word + 4u; ++i)
      bits |= code_of(i < held_end ? sums[i - held] : 0u) << (8u * (i % 4u));
    codes[word] = bits;
  }
}
