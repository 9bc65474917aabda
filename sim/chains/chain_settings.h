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

namespace cuticle::sim::chains {

/// What every solver of rigid links can be set to, beside its own.
struct ChainParameters {
  double inner_step = 0.0020833333333333333;
  std::uint32_t max_substeps = 64;
  double damping = 2;
  bool sag_free = true, double_precision = false;
};
constexpr registry::Parameter k_double_precision = registry::row(
    "double_precision", "1", 0, 0,
    "the CPU computes in double, without wide vectors; with an inner_step of 1/1000 s or less it does in any case");
/// In float the rounding of places, over the step's square, is an acceleration of its own.
constexpr double k_least_step_in_float = 1.01e-3;  ///< s
inline bool computes_in_double(const ChainParameters& solver) {
  return solver.double_precision || solver.inner_step < k_least_step_in_float;
}

/// Those, and what the effects that act in the solver have.
struct ChainSettings : ChainParameters {
  std::uint32_t clamped_vertices = 1;
  double shape_stiffness = 0, shape_tip = 0;
  glm::dvec3 gravity{0};                                         ///< m/s^2, less buoyancy; zero without the effect
  Pushes pushes = {};                                            ///< of "wind", "water" and such
  std::optional<colliders::ContactSettings> contact = {};        ///< present with the effect
  std::optional<strand_interaction::Settings> interaction = {};  ///< present with the effect
  std::optional<sleep::Settings> sleep = {};                     ///< present with the effect
  std::optional<clumping::Settings> clumping = {};               ///< present with the effect
};
ChainSettings make_chain_settings(const ChainParameters& solver, const EffectBlocks& effects);

/// All substeps of a frame, with their effects, are one kernel.
inline std::uint32_t one_dispatch(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

/// Error: usage where effects exclude each other.
Result<void> check(const ChainSettings& settings);

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
std::vector<Push> pushes_of(std::span<const ChainStep<Real>> steps);

}  // namespace cuticle::sim::chains
