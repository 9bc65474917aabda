#pragma once
// Visibility functions of the texels of the light's view (Lokovic and Veach 2000), as straight pieces between knots.
#include <cstdint>
#include <span>
#include <vector>

#include "shadows/fragment_lists.h"

namespace cuticle::shadows::deep_shadow {

/// A point of a visibility function: the part of the light that reaches this depth, in steps.
struct Knot {
  float depth = 0, visibility = 1;
};

/// A texel's function through its fragments: it falls over the step that holds each; `per_unit`: -k / scale.
void exact_function(std::span<const Fragment> fragments, float per_unit, std::vector<Knot>& knots);

/// The knots of a function within `bound` of the exact one everywhere, never rising: each piece goes as far as some
/// slope stays within the bound at all points passed, and takes the middle of those slopes (section 3.2 of the paper).
/// `exact`: depths rising, visibility falling.
void compress(std::span<const Knot> exact, double bound, std::vector<Knot>& knots);
/// The same with at most `pieces` pieces: the bound grows by halves until they suffice.
void compress_to(std::span<const Knot> exact, double bound, std::size_t pieces, std::vector<Knot>& knots);

/// How a knot is kept: 16 bits of depth and 16 of visibility; or 9 of depth, over the depths of its tile, and 7.
enum class KnotStorage { words, halves };
/// Texels along each side of a tile.
inline constexpr std::uint32_t k_tile_side = 8;
inline constexpr std::uint32_t k_tile_texels = k_tile_side * k_tile_side;
/// Most pieces of one texel: a tile's knots are counted in 16 bits.
inline constexpr std::uint32_t k_max_pieces = 256;

/// Where a tile's knots begin, and the table of where those of its texels do; a tile without knots has no such table.
struct KnotTile {
  std::uint32_t first_knot = 0, first_begin = 0;
  std::uint16_t depth = 0, step = 1;  ///< of halves: depth steps of code 0, and between codes
};

/// The knots of a map's texels, tile by tile.
struct PackedFunctions {
  KnotStorage storage = KnotStorage::words;
  std::uint32_t columns = 0, tile_columns = 0;  ///< texels and tiles along a row of the map
  std::vector<KnotTile> tiles;                  ///< row by row, and the end
  std::vector<std::uint16_t> begin_in_tile;     ///< the knot, counted from its tile's first, where a texel's begin
  std::vector<std::uint16_t> numbers;           ///< two a knot of words, one a knot of halves

  std::size_t bytes() const { return sizeof(KnotTile) * tiles.size() + 2 * (begin_in_tile.size() + numbers.size()); }
};

/// All functions of the lists, each within `bound` unless `pieces` do not suffice for that. Halves add up to 1/254 to
/// the visibility and move knots by up to 1/1022 of the depths of their tile.
PackedFunctions pack(const FragmentLists& lists, float per_unit, double bound, std::size_t pieces, KnotStorage storage);

/// Depth steps by which a texel's knots may have moved where they are kept.
float depth_rounding(const PackedFunctions& functions, std::size_t texel);
/// A texel's visibility at a depth, in steps: 1 before the first knot, the last knot's behind it, linear between.
float visibility_at(const PackedFunctions& functions, std::size_t texel, float depth);

}  // namespace cuticle::shadows::deep_shadow
