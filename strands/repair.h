#pragma once
// Mends what a damaged file holds, by stated rules, and counts it.
#include <cstddef>
#include <string>
#include <vector>

#include "strands/groom.h"

namespace cuticle::strands {

/// What repair() did.
struct Repairs {
  std::size_t points_not_finite = 0;       ///< taken out
  std::size_t coincident_points = 0;       ///< taken out
  std::size_t strands_of_one_point = 0;    ///< taken out: fewer than two finite points
  std::size_t strands_without_length = 0;  ///< taken out: all points coincide
  std::size_t points_added = 0;            ///< put back into longest segments
  std::size_t values_replaced = 0;         ///< radii, uv and attributes that are not finite, radii below 0: now 0
  bool operator==(const Repairs&) const = default;
};

/// Mends a groom whose arrays have the right sizes (offsets may repeat):
/// 1. a radius, uv or attribute value that is not finite, or a radius below 0, becomes 0;
/// 2. a point that is not finite, or the same as the one before it, is taken out;
/// 3. a strand of fewer than two points that are left is taken out;
/// 4. a strand that lost points gets its old number of points back: its longest segment is divided evenly, again and
///    again, so that lengths stay what they were and files that need equal numbers can still be written.
/// The mended groom is valid; it has no strands where none could be kept.
Repairs repair(Groom& groom);

/// One sentence for each kind that was found; none where nothing was.
std::vector<std::string> sentences(const Repairs& repairs);

}  // namespace cuticle::strands
