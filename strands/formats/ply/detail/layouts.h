#pragma once
// Where the strands of a PLY file begin and end: the layouts of the programs that write them.
#include <cstdint>
#include <string>
#include <vector>

#include "strands/formats/ply/detail/elements.h"

namespace cuticle::strands::ply {

/// Rows of `vertex`, strand after strand, and how they were found.
struct Layout {
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint32_t> rows;
  std::string found;
};

/// In this order: an element `strand` with `nsegs`, the segments of each (hairutil, and ours); an element `edge` with
/// `vertex1`, `vertex2`, whose chains are strands (Open3D's LineSet); a cloud whose colours change evenly, one colour a
/// strand (NeuralHaircut, HAAR); a cloud of a multiple of 100 points, 100 a strand (GaussianHaircut). Error: bad_input
/// naming what does not fit, or that no layout does.
Result<Layout> find_layout(const Elements& elements, const std::string& where);

}  // namespace cuticle::strands::ply
