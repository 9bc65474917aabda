#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel: its depths in one word, and what lies in each layer becomes what lies before its end.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 1) writeonly buffer Ranges { uint ranges[]; };
layout(std430, binding = 2) buffer Sums { uint sums[]; };
layout(std430, binding = 3) readonly buffer Box { uint least[6]; };

void main() {
  const uint kept = invocation();
  if (kept >= push.count) return;
  uint t = kept;
  for (bool in_strips = strip_count() > 1u; in_strips; in_strips = false) {  // skipped where a condition would be masked
    placement_of(least);
    t += first_kept;
    if (t >= end_kept) return;
  }
  const uint nearest = depths[2u * t];
  ranges[t] = depth_range(nearest, ~depths[2u * t + 1u]);
  const uint first = kept * push.layers;
  if (nearest == k_no_depth) return;
  uint total = sums[first];
  for (uint i = 1u; i < push.layers; ++i) {
    total += sums[first + i];
    sums[first + i] = total;
  }
}
