#pragma once
// Sparse maps: the tiles of a map that hold hair.
#include "shadows/deep_opacity/deep_map.h"

namespace cuticle::shadows::deep_opacity {

/// Leaves of a map's texels those of the tiles that hold hair, tile by tile, with each tile's slot in Map::slots; of
/// tiles beyond the first `room`, nothing (counted in Map::clamped, their texels). Before packing.
void keep_tiles(Map& map, std::size_t room);

/// Where a texel of the map is stored, or k_no_slot.
std::uint32_t stored_texel(const Map& map, std::size_t texel);

/// Tiles that a map of the settings has room for.
std::size_t tile_room(const Settings& settings);

}  // namespace cuticle::shadows::deep_opacity
