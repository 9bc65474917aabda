#pragma once
// The energy of one strand of `rod` by the turns of its links: the same hinges as the substeps have (rod_step.glslh),
// with the angles free, in double. Links cannot stretch, so that turning them is all that a strand can do.
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "sim/chains/chains.h"
#include "sim/colliders/placed.h"

namespace cuticle::sim::rod {

/// k/2 |B - natural|^2 + g/2 (twist - natural twist)^2 between two links' material frames (Bergou et al. 2008, in the
/// symmetric split of a turn: half the twist, the bend B as a vector across, half the twist).
struct HingeEnergy {
  double bending = 0, twisting = 0;                        ///< over the mean link's mass, m^2/s^2
  double natural_x = 0, natural_y = 0, natural_twist = 0;  ///< radians
};

/// Index i: link i, from vertex i - 1 to i, and the hinge at vertex i - 1; index 0 is the clamp and the anchor. Masses
/// over the mean link's.
struct RodStrand {
  std::vector<double> lengths, masses;
  std::vector<HingeEnergy> hinges;
  std::vector<glm::dquat> rest;  ///< material frames at rest: z along the link, x the director; [0] the clamp's
  glm::dvec3 anchor{0};          ///< metres, rest space
  std::size_t links() const { return lengths.size() - 1; }
  double length() const;
  double weight(const glm::dvec3& gravity) const;  ///< m/s^2 times the mean link's mass
};
/// `hinges`: of make_hinges.
template <class Real>
RodStrand rod_strand(const chains::Chains<Real>& chains, const chains::Rows<Real>& hinges, std::size_t strand);

/// What holds a strand away: a penalty at vertices and at the middles of links.
struct Contacts {
  std::vector<PlacedCollider> near;  ///< those that the strand may reach
  double stiffness = 0;              ///< over the mean link's mass, 1/s^2
  /// How near a place may lie, metres: [2 i] of vertex i, [2 i - 1] of the middle of link i.
  std::vector<double> clearance;
};

struct Load {
  glm::dvec3 gravity{0};
  const Contacts* contacts = nullptr;  ///< none: null
};

/// The links' frames, [0] the clamp's.
using Frames = std::vector<glm::dquat>;

std::vector<glm::dvec3> places_of(const RodStrand& strand, std::span<const glm::dquat> frames);

/// Over the mean link's mass, m^2/s^2. `magnitude`: what its terms add up to, for what rounding can do to it.
struct Energy {
  double value = 0, magnitude = 0;
};
Energy energy_of(const RodStrand& strand, const Frames& frames, const Load& load);

/// Newton's step, found from the tip to the root and back in time that grows with the links: after a link's turn is
/// eliminated, what lies beyond is a quadratic form of where its root end moves and how its parent turns.
struct NewtonStep {
  std::vector<glm::dvec3> turns;  ///< of the links, world axes; [0] none
  double moment = 0;              ///< the largest that is not balanced, over the mean link's mass, m^2/s^2
  double slope = 0;               ///< of the energy along the turns
  /// All pivots are positive: the form is positive definite, and the equilibrium, if it is one, stable. Otherwise the
  /// turns are not set.
  bool is_definite = true;
};
/// `shift` is added to every link's resistance to turning, m^2/s^2.
NewtonStep newton_step(const RodStrand& strand, const Frames& frames, const Load& load, double shift);

Frames turned(const Frames& frames, std::span<const glm::dvec3> turns, double share);

}  // namespace cuticle::sim::rod
