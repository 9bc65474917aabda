#include "shadows/deep_opacity/tiles.h"

#include <algorithm>
#include <cmath>

#include "shadows/deep_opacity/tiles.glslh"

namespace cuticle::shadows::deep_opacity {
namespace {

using Word = std::uint32_t;

/// Tiles that hold a texel with hair, in their order.
std::vector<Word> tiles_with_hair(const Map& map) {
  const Word columns = map.view.columns;
  std::vector<bool> holds(std::size_t(tiles_across(columns)) * tiles_across(map.view.rows));
  for (Word j = 0; j < map.view.rows; ++j)
    for (Word i = 0; i < columns; ++i)
      if (map.ranges[std::size_t(j) * columns + i] != k_no_range) holds[tile_of(i, j, columns)] = true;
  std::vector<Word> tiles;
  for (std::size_t tile = 0; tile < holds.size(); ++tile)
    if (holds[tile]) tiles.push_back(Word(tile));
  return tiles;
}

/// The texel of a map at a place of a tile, or k_no_slot beyond the map.
std::size_t texel_at(const MapView& view, Word tile, Word place) {
  const Word i = tile_column(tile, place, view.columns), j = tile_row(tile, place, view.columns);
  return i < view.columns && j < view.rows ? std::size_t(j) * view.columns + i : k_no_slot;
}

}  // namespace

void keep_tiles(Map& map, std::size_t room) {
  std::vector<Word> tiles = tiles_with_hair(map);
  if (tiles.size() > room) {
    map.clamped = k_tile_texels * (tiles.size() - room);
    tiles.resize(room);
  }
  map.slots.assign(std::size_t(tiles_across(map.view.columns)) * tiles_across(map.view.rows), k_no_slot);
  const std::size_t layers = map.ends.count;
  std::vector<Word> ranges(tiles.size() * k_tile_texels, k_no_range), sums(ranges.size() * layers);
  for (std::size_t slot = 0; slot < tiles.size(); ++slot) {
    map.slots[tiles[slot]] = Word(slot);
    for (Word place = 0; place < k_tile_texels; ++place) {
      const std::size_t texel = texel_at(map.view, tiles[slot], place), stored = slot * k_tile_texels + place;
      if (texel == k_no_slot) continue;
      ranges[stored] = map.ranges[texel];
      std::copy_n(map.sums.begin() + std::ptrdiff_t(texel * layers), layers,
                  sums.begin() + std::ptrdiff_t(stored * layers));
    }
  }
  map.ranges = std::move(ranges);
  map.sums = std::move(sums);
}

Word stored_texel(const Map& map, std::size_t texel) {
  const Word i = Word(texel) % map.view.columns, j = Word(texel) / map.view.columns;
  const Word slot = map.slots[tile_of(i, j, map.view.columns)];
  return slot == k_no_slot ? k_no_slot : slot * k_tile_texels + place_in_tile(i, j);
}

std::size_t tile_room(const Settings& settings) {
  return std::max<std::size_t>(1, std::size_t(settings.tile_share * double(most_tiles(settings.map.resolution))));
}

}  // namespace cuticle::shadows::deep_opacity
