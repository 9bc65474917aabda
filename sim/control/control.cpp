#include "sim/control/control.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "sim/control/control.glslh"
#include "sim/rest_pose.h"

namespace cuticle::sim::control {
namespace {

/// Of the groom's attribute "control" (of strands or vertices); 1 without.
float painted(const strands::Groom& rest, std::size_t strand, std::size_t vertex) {
  const auto found = rest.attributes.find("control");
  if (found == rest.attributes.end() || found->second.components != 1) return 1;
  const std::vector<float>& values = found->second.values;
  const std::size_t index = found->second.domain == strands::Attribute::Domain::strand ? strand : vertex;
  return index < values.size() ? std::clamp(values[index], 0.f, 1.f) : 1.f;
}

std::vector<float> base_weights(const strands::Groom& rest, const Control& control) {
  const RestPose pose = make_rest_pose(rest, 1);
  const float at_root = static_cast<float>(control.root), at_tip = static_cast<float>(control.tip);
  std::vector<float> weights(rest.vertex_count());
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s]; i < rest.offsets[s + 1]; ++i)
      weights[i] = control_at(at_root, at_tip, pose.traits[i].y) * painted(rest, s, i);
  return weights;
}

Result<void> check(const FrameInput& input, std::size_t vertices) {
  const auto sized = [&](std::string_view name, std::size_t count) -> Result<void> {
    if (count == 0 || count == vertices) return {};
    return bad_input(fmt::format("{}: {} entries for {} vertices", name, count, vertices));
  };
  CUTICLE_TRY(sized("authored", input.authored.size()));
  CUTICLE_TRY(sized("control", input.control.size()));
  for (std::size_t i = 0; i < input.authored.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(input.authored[i][c]))
        return bad_input(fmt::format("authored[{}]: component {} is not finite", i, c));
  for (std::size_t i = 0; i < input.control.size(); ++i)
    if (!(input.control[i] >= 0 && input.control[i] <= 1))
      return bad_input(fmt::format("control[{}]: {} is outside 0 .. 1", i, input.control[i]));
  return {};
}

/// 1 from `begin` to `end`, falling to 0 within `fade` before and after.
double window(double time, double begin, double end, double fade) {
  const double outside = std::max({begin - time, time - end, 0.0});
  if (outside == 0) return 1;
  return fade > 0 ? std::max(0.0, 1 - outside / fade) : 0.0;
}

class ControlledSolver final : public Solver {
 public:
  ControlledSolver(std::unique_ptr<Solver> solver, Authored authored)
      : solver_(std::move(solver)), authored_(std::move(authored)) {}

  Result<void> advance(const FrameInput& input) override {
    Authored next = authored_;
    CUTICLE_TRY(next.advance(input));
    CUTICLE_TRY(solver_->advance(input));
    authored_ = std::move(next);
    return {};
  }

  Result<State> state() override {
    CUTICLE_ASSIGN(State state, solver_->state());
    authored_.blend(state);
    return state;
  }

 private:
  std::unique_ptr<Solver> solver_;
  Authored authored_;
};

}  // namespace

Authored::Authored(const strands::Groom& rest, const Control& control)
    : rest_(rest.positions),
      places_(rest.positions),
      velocities_(rest.vertex_count(), glm::vec3(0)),
      base_(base_weights(rest, control)),
      weights_(rest.vertex_count(), 0.f),
      weight_rates_(rest.vertex_count(), 0.f),
      control_(control) {}

Result<void> Authored::advance(const FrameInput& input) {
  CUTICLE_TRY(check(input, rest_.size()));
  const bool still = !placed_ || input.teleport || !(input.duration > 0);
  const float per_second = still ? 0.f : static_cast<float>(1 / input.duration);
  time_ += input.duration;
  const float share = static_cast<float>(window(time_, control_.begin, control_.end, control_.fade));
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    const glm::vec3 place =
        input.authored.empty() ? glm::vec3(input.head_end * glm::dvec4(rest_[i], 1)) : input.authored[i];
    const float weight = base_[i] * share * (input.control.empty() ? 1.f : input.control[i]);
    velocities_[i] = (place - places_[i]) * per_second;
    weight_rates_[i] = (weight - weights_[i]) * per_second;
    places_[i] = place;
    weights_[i] = weight;
  }
  placed_ = true;
  return {};
}

void Authored::blend(State& state) const {
  if (!placed_) return;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const glm::vec3 simulated = state.positions[i];
    state.positions[i] = blended(simulated, places_[i], weights_[i]);
    state.velocities[i] =
        blended_velocity(state.velocities[i], velocities_[i], places_[i] - simulated, weights_[i], weight_rates_[i]);
  }
}

std::unique_ptr<Solver> controlled(std::unique_ptr<Solver> solver, const strands::Groom& rest, const Control& control) {
  return std::make_unique<ControlledSolver>(std::move(solver), Authored(rest, control));
}

}  // namespace cuticle::sim::control
