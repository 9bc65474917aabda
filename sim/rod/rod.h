#pragma once
// The rod solver: chains that cannot stretch, bend as fibres do, and twist.
#include <memory>

#include "sim/chains/chain_settings.h"
#include "sim/rod/hinges.h"

namespace cuticle::sim::rod {

struct Rod : chains::ChainParameters {
  static constexpr std::string_view name = "rod";
  double young_modulus = 3.9e9, shear_modulus = 0.9e9, fibre_radius = 3.5e-5, density = 1300;
  double stiffen_at_most = 1000;
  std::uint32_t clamped_vertices = 1;
};
void describe(registry::Members& members, Rod& rod);

/// Those and what its effects have, as the substeps need them.
struct Settings {
  chains::ChainSettings chain;
  Stiffness stiffness;
  glm::dvec3 balanced_gravity{0};  ///< that the natural shape holds up; zero unless sag_free
  double stiffen_at_most = 1;      ///< of a strand whose rest pose would not be stable: holding.h
};
Settings make_settings(const registry::ParameterValues& values, const EffectBlocks& effects);

/// A solver for these strands, in metres. Effects that are read: "gravity", "colliders", "wind", "water". Threads,
/// lengths, welded segments and resets: as sim/exact. The bent rest pose is kept; a clamped rod under gravity is the
/// discrete elastica to 3e-5 of H/W at any step (RodTruth.HeavyElastica_...). Error: that of strands::validate.
Result<std::unique_ptr<Solver>> create(const strands::Groom& rest, const registry::ParameterValues& solver,
                                       const EffectBlocks& effects);

}  // namespace cuticle::sim::rod
