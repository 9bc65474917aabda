#version 460
// Mean depth of each part of the cards, along the camera's axis.
#extension GL_GOOGLE_include_directive : require
#include "gpu/groups.glsl"
#include "render/passes/cards/card_parts.glsl"
#include "render/passes/cards/card_rows.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Parts { SortedPart parts[]; };
layout(std430, set = 0, binding = 1) readonly buffer Placed { PlacedRow placed[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Depths { float depths[]; };
layout(push_constant) uniform Push {
  vec4 eye, forward;
  uint part_count;
};

void main() {
  const uint part = invocation();
  if (part >= part_count) return;
  float sum = 0.0;
  for (uint r = parts[part].first_row; r < parts[part].first_row + parts[part].row_count; ++r)
    sum += dot(0.5 * (placed[r].left.xyz + placed[r].right.xyz) - eye.xyz, forward.xyz);
  depths[part] = sum / float(parts[part].row_count);
}
