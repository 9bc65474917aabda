#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per texel of the tiles that there is room for: its range and sums, from those of the whole map.
layout(local_size_x = 64) in;
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/deep_opacity/tiles.glslh"
#include "shadows/map_geometry.glsl"

layout(std430, binding = 0) readonly buffer Box { uint least[6]; };
layout(std430, binding = 1) readonly buffer List { uint list[]; };
layout(std430, binding = 2) readonly buffer Ranges { uint ranges[]; };
layout(std430, binding = 3) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 4) writeonly buffer StoredRanges { uint stored_ranges[]; };
layout(std430, binding = 5) writeonly buffer StoredSums { uint stored_sums[]; };

void main() {
  const uint stored = invocation(), slot = stored / k_tile_texels, place = stored % k_tile_texels;
  const uint room = uint(push.own[0]);
  if (slot >= min(room, list[room])) return;
  placement_of(least);
  const uint i = tile_column(list[slot], place, columns), j = tile_row(list[slot], place, columns);
  const bool is_inside = i < columns && j < rows;
  const uint texel = is_inside ? j * columns + i : first_kept;
  if (!is_kept(texel)) return;
  stored_ranges[stored] = is_inside ? ranges[texel] : k_no_range;
  for (uint layer = 0u; layer < push.layers; ++layer)
    stored_sums[stored * push.layers + layer] = is_inside ? sums[kept_place(texel) * push.layers + layer] : 0u;
}
