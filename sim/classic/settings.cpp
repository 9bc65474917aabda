#include "sim/classic/settings.h"

#include <algorithm>
#include <cmath>

#include "sim/gravity/gravity.h"
#include "sim/turn.glslh"

namespace cuticle::sim::classic {
std::uint32_t substeps(const Settings& settings, double duration) {
  return inner_steps(duration, settings.inner_step, settings.max_substeps);
}

namespace {

bool pushes(std::string_view effect) {
  const auto found = find_effect(effect);
  return found && (*found)->push;
}

}  // namespace

Result<void> check_effects(const EffectBlocks& effects) {
  for (const auto& [name, values] : effects)
    if (name != "gravity" && name != "colliders" && name != "control" && !pushes(name))
      return usage_error("the solver 'classic' has no effect '" + name + "'", "choose the solver 'exact'");
  return {};
}

Settings make_settings(const Classic& solver, const EffectBlocks& effects) {
  Settings settings{solver};
  settings.sag_free = solver.sag_free && solver.shape_stiffness > 0;
  if (const auto gravity = find_effect<gravity::Gravity>(effects)) settings.gravity = gravity->acceleration;
  settings.pushes = effect_pushes(effects);
  settings.gravity *= settings.pushes.weight_left;
  settings.contact = find_effect<colliders::ContactSettings>(effects);
  return settings;
}

namespace {

/// The pull towards the rest pose carries the weight that the strand has there; the head turns that force along.
glm::dvec3 balancing_force(const Settings& settings, const glm::vec4& rotation) {
  const glm::dvec4 q(rotation);
  return settings.sag_free ? turned(settings.gravity, glm::dvec3(q), q.w) : glm::dvec3(0);
}

/// What drag leaves of an acceleration's gain in a step: so that a particle in a stream takes on its velocity, and
/// weight and stream balance at one angle, whatever the step.
double left_by_drag(double rate) { return rate > 0 ? -std::expm1(-rate) / rate : 1; }

}  // namespace

StepConstants make_step(const Settings& settings, const Substep& substep, std::uint32_t strand_count) {
  const double h = substep.duration;
  StepConstants step;
  step.carry = substep.carry;
  step.rotation_begin = substep.rotation_begin;
  step.rotation_end = substep.rotation_end;
  step.head_step = substep.translation_step;
  Push push = settings.pushes.at(substep.time);
  push.drag += settings.damping;
  step.velocity_to_step = static_cast<float>(h * std::exp(-push.drag * h));
  const glm::dvec3 acceleration =
      settings.gravity - balancing_force(settings, substep.rotation_end) + push.acceleration;
  step.fall = glm::vec3(acceleration * double(substep.gravity_factor) * left_by_drag(push.drag * h));
  step.shape_rate = static_cast<float>(settings.shape_stiffness * h);
  step.shape_tip = settings.shape_tip;
  step.inverse_duration = h > 0 ? static_cast<float>(1 / h) : 0.f;
  step.strand_count = strand_count;
  step.clamped_vertices = settings.clamped_vertices;
  return step;
}

}  // namespace cuticle::sim::classic
