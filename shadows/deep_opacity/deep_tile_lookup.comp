#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: looks it up in a sparse map.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/deep_exponent.glsl"
#include "shadows/deep_opacity/tiles.glslh"
#define STRAND_LIST_BINDING 9
#include "strands/lod/strand_list.glsl"

layout(std430, binding = 8) readonly buffer Slots { uint slots[]; };

float exponent_at(uint texel, float z) {
  const uint i = texel % columns, j = texel / columns;
  const uint slot = slots[tile_of(i, j, columns)];
  const bool is_stored = slot != k_no_slot;
  const float exponent = stored_exponent(is_stored ? slot * k_tile_texels + place_in_tile(i, j) : 0u, z);
  return is_stored ? exponent : 0.0;
}

void main() {
  const uint v = listed_vertex(invocation());
  if (v < push.count) look_up(placement_of(least), v);
}
