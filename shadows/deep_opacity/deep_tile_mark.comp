#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel: marks the tiles that hold hair, by 1 where there was 0.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/tiles.glslh"
#include "shadows/map_geometry.glsl"
#include "shadows/splat.glslh"

layout(std430, binding = 0) readonly buffer Box { uint least[6]; };
layout(std430, binding = 1) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 2) writeonly buffer Slots { uint slots[]; };

void main() {
  const uint t = invocation();
  placement_of(least);
  if (t >= columns * rows) return;
  if (depths[2u * t] != k_no_depth) slots[tile_of(t % columns, t / columns, columns)] = 1u;
}
