#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel: sorts its list by depth, then deposit (Shell 1959), and turns deposits into sums.
layout(local_size_x = 64) in;
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) readonly buffer First { uint first[]; };
layout(std430, binding = 1) buffer Fragments { uvec2 fragments[]; };

bool is_behind(uvec2 a, uvec2 b) { return a.x != b.x ? a.x > b.x : a.y > b.y; }

/// Moves the fragment at `i` forward by whole gaps, not before `begin`, until the one before it belongs there.
void sink(uint begin, uint i, uint gap) {
  const uvec2 fragment = fragments[i];
  while (i >= begin + gap && is_behind(fragments[i - gap], fragment)) {
    fragments[i] = fragments[i - gap];
    i -= gap;
  }
  fragments[i] = fragment;
}

void main() {
  const uint t = invocation();
  if (t >= push.count) return;
  const uint begin = min(first[t], push.layers), end = min(first[t + 1u], push.layers);
  for (uint gap = (end - begin) / 2u; gap > 0u; gap = gap == 2u ? 1u : gap * 5u / 11u)
    for (uint i = begin + gap; i < end; ++i) sink(begin, i, gap);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) {
    sum += fragments[i].y;
    fragments[i].y = sum;
  }
}
