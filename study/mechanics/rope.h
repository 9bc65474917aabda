#pragma once
// Private to study/mechanics: a rope over a support, a slack loop on its root's side, a free end on the other.
#include <string>

#include "core/rounded_box.h"
#include "sim/solver.h"

namespace cuticle::study::mechanics {

/// A support half round which the rope runs: a cylinder along z, or a bar with two sharp edges, as wide as the
/// cylinder.
struct Support {
  bool has_edges = false;
  double radius = 0.05;  ///< m; of the bar half its width
  RoundedBox shape() const;
};

/// Lengths in links, each radius * pi / `round` long on a cylinder's surface or its chord, 2 radius / `round` on a bar.
struct Rope {
  int round = 16, loop = 8, hang = 30;
  double link(const Support& support) const;
  strands::Groom groom(const Support& support) const;
  double loop_tension(const Support& support) const { return loop * link(support); }  ///< over the weight per length, m
  double free_tension(const Support& support) const { return (hang - 0.5) * link(support); }
};

/// The free end's tension at which the rope slips, over its weight per length (m): the capstan's law with the rope's
/// own weight.
double slipping_tension(const Support& support, double loop_tension, double friction);
/// The friction at which such a free tension just slips.
double law_friction(const Support& support, double loop_tension, double free_tension);

}  // namespace cuticle::study::mechanics
