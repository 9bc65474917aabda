#pragma once
// One card from the strands that it stands for.
#include "strands/cards/arc_strand.h"
#include "strands/cards/cards.h"

namespace cuticle::strands {

struct CardShape {
  int segments = 12;
  double width = 0, within = 0.95, outward = 0.5;  ///< as CardParameters has them
};
struct BuiltCard {
  std::vector<CardRow> rows;
  float length = 0;
};
/// `members`: strands of `all`, one at least.
BuiltCard build_card(std::span<const ArcStrand> all, std::span<const std::uint32_t> members, float fibre_radius,
                     const CardBody& body, const CardShape& shape);
/// The row between the two on either side of v (0 .. 1).
CardRow row_at(std::span<const CardRow> rows, float v);

}  // namespace cuticle::strands
