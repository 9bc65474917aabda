#include "sim/chains/chain_settings.h"

#include <fmt/core.h>

#include "sim/chains/placing.h"
#include "sim/gravity/gravity.h"

namespace cuticle::sim::chains {
namespace {

/// Steps whose durations differ more than this start anew with the first order: BDF2 loses its stability past 1 +
/// sqrt 2.
constexpr double k_largest_ratio = 2;

template <class Real>
void set_scheme(ChainStep<Real>& step, double duration, double previous) {
  const double ratio = previous > 0 ? duration / previous : 0;
  const bool second = ratio >= 1 / k_largest_ratio && ratio <= k_largest_ratio;
  step.duration = Real(duration);
  step.per_second = Real(1 / duration);
  step.first_order = second ? Real(0) : Real(1);
  step.history = Real(ratio * ratio / (1 + 2 * ratio));
  step.gain = Real((1 + ratio) / (1 + 2 * ratio));
}

template <class Real>
void set_rotations(ChainStep<Real>& step, const glm::dmat3& begin, const glm::dmat3& end) {
  using Vector = glm::vec<3, Real>;
  step.begin_x = Vector(begin[0]);
  step.begin_y = Vector(begin[1]);
  step.begin_z = Vector(begin[2]);
  step.end_x = Vector(end[0]);
  step.end_y = Vector(end[1]);
  step.end_z = Vector(end[2]);
}

/// The pull towards the rest pose carries the weight that the strand has there; the head turns that force along.
glm::dvec3 unbalanced_gravity(const ChainSettings& settings, const glm::dmat3& rotation) {
  const bool balanced = settings.sag_free && settings.shape_stiffness > 0;
  return balanced ? settings.gravity - rotation * settings.gravity : settings.gravity;
}

}  // namespace

std::uint32_t substeps(const ChainSettings& settings, double duration) {
  return inner_steps(duration, settings.inner_step, settings.max_substeps);
}

ChainSettings make_chain_settings(const ChainParameters& solver, const EffectBlocks& effects) {
  ChainSettings settings{solver};
  if (const auto gravity = find_effect<gravity::Gravity>(effects)) settings.gravity = gravity->acceleration;
  settings.pushes = effect_pushes(effects);
  settings.gravity *= settings.pushes.weight_left;
  settings.contact = find_effect<colliders::ContactSettings>(effects);
  settings.interaction = find_effect<strand_interaction::Settings>(effects);
  settings.sleep = find_effect<sleep::Settings>(effects);
  settings.clumping = find_effect<clumping::Settings>(effects);
  return settings;
}

Result<void> check(const ChainSettings& settings) {
  if (!settings.sleep || (!settings.interaction && !settings.clumping)) return {};
  return usage_error(fmt::format("the effects 'sleep' and '{}' exclude each other",
                                 settings.interaction ? "strand_interaction" : "clumping"),
                     "leave one of them out: strands that move each other are not at rest one by one");
}

template <class Real>
std::vector<ChainStep<Real>> ChainClock::steps(const ChainSettings& settings, std::span<const Substep> parts) {
  using Vector = glm::vec<3, Real>;
  std::vector<ChainStep<Real>> steps;
  for (const Substep& part : parts) {
    const double duration = double(part.duration);
    if (!(duration > 0)) continue;
    time_ += duration;
    const Push push = settings.pushes.at(time_);
    const glm::dmat3 end = matrix_of(part.rotation_end);
    ChainStep<Real> step{};
    set_scheme(step, duration, previous_duration_);
    set_rotations(step, matrix_of(part.rotation_begin), end);
    step.head_step = Vector(part.translation_step);
    step.acceleration = Vector(unbalanced_gravity(settings, end) + push.acceleration);
    step.drag = Real(settings.damping + push.drag);
    if (settings.contact) {
      step.friction = Real(settings.contact->friction);
      step.pearl = Real(settings.contact->pearl_radius);
    }
    previous_duration_ = duration;
    steps.push_back(step);
  }
  return steps;
}
template std::vector<ChainStep<float>> ChainClock::steps<float>(const ChainSettings&, std::span<const Substep>);
template std::vector<ChainStep<double>> ChainClock::steps<double>(const ChainSettings&, std::span<const Substep>);

template <class Real>
std::vector<Push> pushes_of(std::span<const ChainStep<Real>> steps) {
  std::vector<Push> pushes;
  for (const ChainStep<Real>& step : steps) pushes.push_back({glm::dvec3(step.acceleration), double(step.drag)});
  return pushes;
}
template std::vector<Push> pushes_of<float>(std::span<const ChainStep<float>>);
template std::vector<Push> pushes_of<double>(std::span<const ChainStep<double>>);

}  // namespace cuticle::sim::chains
