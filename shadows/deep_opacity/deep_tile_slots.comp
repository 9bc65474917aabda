#version 460
#extension GL_GOOGLE_include_directive : require
// One work group: marks of tiles become slots, in the order of the tiles, as far as there is room; and the tile of each
// slot is listed, with the number of marks behind the list.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/tiles.glslh"
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) readonly buffer Box { uint least[6]; };
layout(std430, binding = 1) buffer Slots { uint slots[]; };
layout(std430, binding = 2) writeonly buffer List { uint list[]; };

const uint k_lanes = 64u;
shared uint before[k_lanes + 1u];  // marks before each lane's tiles, and of all

void main() {
  const uint lane = gl_LocalInvocationID.x, room = uint(push.own[0]);
  placement_of(least);
  const uint tiles = tiles_across(columns) * tiles_across(rows), each = (tiles + k_lanes - 1u) / k_lanes;
  const uint first = min(tiles, lane * each), end = min(tiles, first + each);
  uint sum = 0u;
  for (uint tile = first; tile < end; ++tile) sum += slots[tile];
  before[lane + 1u] = sum;
  if (lane == 0u) before[0] = 0u;
  barrier();
  if (lane == 0u)
    for (uint i = 0u; i < k_lanes; ++i) before[i + 1u] += before[i];
  barrier();
  uint slot = before[lane];
  for (uint tile = first; tile < end; ++tile) {
    const bool holds = slots[tile] != 0u, is_stored = holds && slot < room;
    if (is_stored) list[slot] = tile;
    slots[tile] = is_stored ? slot : k_no_slot;
    slot += holds ? 1u : 0u;
  }
  if (lane == 0u) list[room] = before[k_lanes];
}
