#pragma once
// The groom at rest under its loads without a step through time: `rod`'s energy at its least, strand by strand.
#include <span>
#include <vector>

#include "core/progress.h"
#include "sim/colliders/placed.h"

namespace cuticle::sim::rod {

struct EquilibriumRequest {
  std::span<const PlacedCollider> colliders = {};  ///< where they stand; heeded with the effect "colliders"
  double residual = 1e-9;                          ///< that counts as balanced
  int most_steps = 300;                            ///< of a strand
};

/// One entry per strand.
struct StrandRest {
  /// The largest moment on a link that is not balanced, over the strand's weight times its length (without gravity its
  /// stiffest hinge instead).
  double residual = 0;
  double depth = 0;  ///< of the deepest vertex or middle of a link in a collider, metres
  int steps = 0;     ///< of Newton's
  bool is_balanced = true;
  bool is_stable = true;  ///< the energy's second derivatives are positive definite there
};
struct Equilibrium {
  std::vector<glm::vec3> positions;  ///< as those of the groom
  std::vector<StrandRest> strands;
};

/// Newton's method on the turns of the links (strand_energy.h), each step damped until the energy falls, from the rest
/// pose, in double, strands in parallel. Of the effects gravity and colliders act, friction does not; a collider
/// presses at vertices and middles of links, and where a vertex lies nearer at rest than the pearl's radius it may stay
/// there. A weight that rests on one vertex sinks in by a micrometre. Cantilevers and catenaries: EquilibriumTruth.
/// Error: that of strands::validate, usage of settings, `internal` when stopped.
Result<Equilibrium> find_equilibrium(const strands::Groom& rest, const registry::ParameterValues& solver,
                                     const EffectBlocks& effects, const EquilibriumRequest& request,
                                     Progress& progress);

}  // namespace cuticle::sim::rod
