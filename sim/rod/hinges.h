#pragma once
// The hinges of rods at rest: what make_chains is to places.
#include "sim/chains/chains.h"

namespace cuticle::sim::rod {

/// Of a fibre, over its mass per length: EI / (rho A) and GJ / (rho A), m^4/s^2.
struct Stiffness {
  double bending = 0, twisting = 0;
};

/// Rows of hinge_row for every vertex of the chains. The clamp is half a cell: a hinge of 2 EI / l_1 against the rest
/// direction of the first link. Hinges bend by half of the adjacent lengths, of which none counts as less than 1/1000
/// of the strand. Without `gravity` (m/s^2, rest space) the rest pose is the natural shape; with it the natural shape
/// is the one that gravity bends and twists into the rest pose, hinge by hinge from the tip, exactly.
template <class Real>
chains::Rows<Real> make_hinges(const chains::Chains<Real>& chains, const Stiffness& stiffness,
                               const glm::dvec3& gravity);

/// The same of one strand of them, written into its rows.
template <class Real>
void put_hinges(const chains::Chains<Real>& chains, std::size_t block, std::size_t lane, const Stiffness& stiffness,
                const glm::dvec3& gravity, chains::Rows<Real>& hinges);

}  // namespace cuticle::sim::rod
