#pragma once
// The exact solver on the CPU: chains of rigid links that cannot stretch, 16 strands at a time.
#include <memory>

#include "sim/chains/chain_settings.h"

namespace cuticle::sim::exact {

/// The solver's parameters and those of its effects as numbers.
struct Exact : chains::ChainParameters {
  static constexpr std::string_view name = "exact";
  std::uint32_t clamped_vertices = 2;
  double shape_stiffness = 12, shape_tip = 0.5;
};
void describe(registry::Members& members, Exact& exact);
chains::ChainSettings make_settings(const registry::ParameterValues& values, const EffectBlocks& effects);

/// A solver for these strands, in metres. Effects that are read: "gravity", "colliders" (spheres, with friction),
/// "wind", "water". Runs blocks of strands in parallel; the result is bit-identical at any number of threads, and a
/// strand's does not depend on those beside it (beside spheres: but for rounding, by which of a block's 16 strands can
/// reach one). Every segment keeps its rest length to max(1e-5, 4 2^-24 L / l) of it in float, relative to the anchor,
/// at any duration (ExactStability, tests); segments shorter than 1e-7 of the strand are welded and stay of no length.
/// A strand whose state is not finite after a frame is put back into the rest pose carried by the head, with the head's
/// velocity, and counted. Error: that of strands::validate.
Result<std::unique_ptr<Solver>> create(const strands::Groom& rest, const registry::ParameterValues& solver,
                                       const EffectBlocks& effects);

}  // namespace cuticle::sim::exact
