#pragma once
// What a groom holds, in figures.
#include <string>
#include <vector>

#include "strands/groom.h"

namespace cuticle::strands {

/// Least, median, mean and greatest of a list; all 0 for an empty one.
struct Spread {
  double least = 0, median = 0, mean = 0, greatest = 0;
};
Spread spread(std::vector<double> values);

/// A strand that has no length, or points that coincide.
struct DegenerateStrand {
  std::size_t strand = 0;
  std::size_t coincident_segments = 0;
  bool has_length = false;
};

struct GroomStatistics {
  std::size_t strands = 0, vertices = 0, least_vertices = 0, greatest_vertices = 0;
  Spread length, segment, radius;     ///< metres
  Bounds bounds;                      ///< metres
  /// Distance between neighbouring fibres, metres: 1/sqrt(strand length per volume), the median over cells of 1/48 of the
  /// largest side that hold hair. 0 where the groom has no extent.
  double spacing = 0;
  std::vector<DegenerateStrand> degenerate;
};
/// `groom` must be valid (see validate).
GroomStatistics statistics(const Groom& groom);

}  // namespace cuticle::strands
