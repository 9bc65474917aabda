#pragma once
// What is not finite is put back, strand by strand.
#include <functional>

#include "sim/chains/placing.h"

#include "sim/chains/chains.h"

namespace cuticle::sim::chains {

/// Where the strand in a lane is carried.
using PlacingOf = std::function<Placing(std::size_t lane)>;

/// Lanes of a block of which any number is not finite go to the rest pose carried by the head, with the head's
/// velocity, and are marked by k_was_reset.
template <class Real>
void reset_broken_lanes(Chains<Real>& chains, std::size_t block, const PlacingOf& placing);

/// One lane put there, broken or not.
template <class Real>
void reset_lane(Chains<Real>& chains, std::size_t block, std::size_t lane, const Placing& placing);

}  // namespace cuticle::sim::chains
