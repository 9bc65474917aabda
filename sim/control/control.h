#pragma once
// N3: hands back what a solver found, blended with an authored motion.
#include <memory>

#include "sim/solver.h"

namespace cuticle::sim::control {

struct Control {
  static constexpr std::string_view name = "control";
  double root = 0.5, tip = 0, begin = 0, end = 1e6, fade = 0.5;
};
void describe(registry::Members& members, Control& control);

/// The authored motion and its weights, frame by frame.
class Authored {
 public:
  Authored(const strands::Groom& rest, const Control& control);
  /// Error: bad_input naming the vertex when FrameInput::authored or ::control has the wrong size, a place is not
  /// finite or a weight is outside 0 .. 1; nothing is then remembered.
  Result<void> advance(const FrameInput& input);
  std::span<const glm::vec3> places() const { return places_; }
  std::span<const float> weights() const { return weights_; }
  std::span<const glm::vec3> velocities() const { return velocities_; }
  std::span<const float> weight_rates() const { return weight_rates_; }  ///< 1/s
  /// The state between the simulated (given) and the authored motion.
  void blend(State& state) const;

 private:
  std::vector<glm::vec3> rest_, places_, velocities_;
  std::vector<float> base_, weights_, weight_rates_;  ///< rates: 1/s
  double time_ = 0;
  Control control_;
  bool placed_ = false;
};

/// A solver whose states are those of `solver` blended with the authored motion; the simulation itself is not touched,
/// so that a weight may rise and fall at any time. See FrameInput for the authored motion and weights of a frame.
std::unique_ptr<Solver> controlled(std::unique_ptr<Solver> solver, const strands::Groom& rest, const Control& control);

}  // namespace cuticle::sim::control
