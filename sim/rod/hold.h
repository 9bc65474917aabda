#pragma once
// What `rod` adds to a strand so that the groom holds (holding.h).
#include <vector>

#include "sim/solver.h"

namespace cuticle::sim::rod {

/// Of a strand: the factor on EI and GJ, and whether its rest pose is then stable.
struct Hold {
  float stiffening = 1;
  bool is_stable = true;
};

/// What the solver with these parameters would add to each strand. Error: that of strands::validate, usage of settings.
Result<std::vector<Hold>> find_holds(const strands::Groom& rest, const registry::ParameterValues& solver,
                                     const EffectBlocks& effects);

}  // namespace cuticle::sim::rod
