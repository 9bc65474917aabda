#pragma once
// A groom that holds: the natural shape that balances the rest pose, and so much stiffness that the balance is stable.
#include <vector>

#include "sim/rod/hold.h"
#include "sim/rod/rod.h"

namespace cuticle::sim::rod {

template <class Real>
struct HeldHinges {
  chains::Rows<Real> rows;  ///< as of make_hinges
  std::vector<Hold> holds;  ///< one per strand
};

/// The natural shape of make_hinges balances the rest pose at any stiffness, but a limp strand tips over from it (an
/// upright one past Gamma 7.84). So each strand gets the least factor, to 1 %, at which the second derivatives of its
/// energy are positive definite at the rest pose under 1.25 times the gravity, at most settings.stiffen_at_most; what
/// is stable stays as it is. After Hsu et al. 2022 and 2023 (sag-free and stable strands), who solve for stiffness
/// hinge by hinge. Without balanced gravity nothing is done.
template <class Real>
HeldHinges<Real> make_held_hinges(const chains::Chains<Real>& chains, const Settings& settings);

}  // namespace cuticle::sim::rod
