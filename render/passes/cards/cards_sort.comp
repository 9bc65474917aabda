#version 460
// The index buffer in the order of this frame: a thread for each part finds where its indices begin and copies them.
#extension GL_GOOGLE_include_directive : require
#include "gpu/groups.glsl"
#include "render/passes/cards/card_parts.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool groups_alone = false;  // parts of the head's group keep their static order
layout(std430, set = 0, binding = 0) readonly buffer Parts { SortedPart parts[]; };
layout(std430, set = 0, binding = 1) readonly buffer Depths { float depths[]; };
layout(std430, set = 0, binding = 2) readonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Sorted { uint sorted[]; };
layout(push_constant) uniform Push { uint part_count; };

const uint k_max_groups = 32u;  // strands/cards/card_mesh.h
shared float group_depths[k_max_groups];

// Mean over the group's parts by their rows.
void take_group_depth(uint group) {
  float sum = 0.0, rows = 0.0;
  for (uint p = 0u; p < part_count; ++p) {
    if (parts[p].group != group) continue;
    sum += depths[p] * float(parts[p].row_count);
    rows += float(parts[p].row_count);
  }
  group_depths[group] = sum / max(rows, 1.0);
}

// Whether part a is drawn before part b: from far to near, equals in the static order.
bool is_before(uint a, uint b) {
  const uint group_a = parts[a].group, group_b = parts[b].group;
  if (groups_alone && group_a != group_b) {
    const float depth_a = group_depths[group_a], depth_b = group_depths[group_b];
    return depth_a > depth_b || (depth_a == depth_b && group_a < group_b);
  }
  if (groups_alone && group_a == 0u) return a < b;
  return depths[a] > depths[b] || (depths[a] == depths[b] && a < b);
}

void main() {
  if (gl_LocalInvocationIndex < k_max_groups) take_group_depth(gl_LocalInvocationIndex);
  barrier();
  const uint part = invocation();
  if (part >= part_count) return;
  uint begin = 0u;
  for (uint other = 0u; other < part_count; ++other)
    if (other != part && is_before(other, part)) begin += parts[other].index_count;
  for (uint k = 0u; k < parts[part].index_count; ++k) sorted[begin + k] = indices[parts[part].first_index + k];
}
