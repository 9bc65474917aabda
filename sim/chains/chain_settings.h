#pragma once
// Parameters of the solvers of rigid links as numbers, and the constants of a frame's substeps: shared by the CPU and
// the kernels.
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/chains/chain_step.glslh"
#include "sim/clumping/settings.h"
#include "sim/colliders/contact.h"
#include "sim/head_motion.h"
#include "sim/sleep/sleep.h"
#include "sim/strand_interaction/settings.h"
#include "sim/water/water.h"
#include "sim/wind/wind.h"

namespace cuticle::sim::chains {

/// Parameters of the solver and of the effects that act in it; see entry.cpp of each for units, ranges and defaults.
struct ChainSettings {
  double inner_step = 0;
  std::uint32_t max_substeps = 1, clamped_vertices = 1;
  double damping = 0, shape_stiffness = 0, shape_tip = 0;
  bool sag_free = false, double_precision = false;
  glm::dvec3 gravity{0};                                    ///< m/s^2, less buoyancy; zero without the effect
  std::optional<wind::Wind> wind;                           ///< present with the effect
  std::optional<water::Water> water;                        ///< present with the effect
  std::optional<colliders::ContactSettings> contact;        ///< present with the effect
  std::optional<strand_interaction::Settings> interaction;  ///< present with the effect
  std::optional<sleep::Settings> sleep;                     ///< present with the effect
  std::optional<clumping::Settings> clumping;               ///< present with the effect
};
/// What every such solver has: inner_step, max_substeps, clamped_vertices, damping, sag_free, double_precision,
/// effects.
ChainSettings make_chain_settings(const registry::ParameterValues& solver, const EffectBlocks& effects);

/// Error: usage where effects exclude each other.
Result<void> check(const ChainSettings& settings);

std::uint32_t substeps(const registry::ParameterValues& solver, double duration);
std::uint32_t substeps(const ChainSettings& settings, double duration);

/// Follows time from frame to frame: what a substep needs to know of the one before, and of the wind.
class ChainClock {
 public:
  /// The substeps of a frame as constants; none when no time passes.
  template <class Real>
  std::vector<ChainStep<Real>> steps(const ChainSettings& settings, std::span<const Substep> parts);

 private:
  double time_ = 0, previous_duration_ = 0;
};

/// What sleep::Watch compares.
template <class Real>
std::vector<sleep::Push> pushes_of(std::span<const ChainStep<Real>> steps);

}  // namespace cuticle::sim::chains
