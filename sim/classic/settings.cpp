#include "sim/classic/settings.h"

#include <algorithm>
#include <cmath>

#include "sim/turn.glslh"

namespace cuticle::sim::classic {
namespace {

std::uint32_t whole(const registry::ParameterValues& values, std::string_view name) {
  return static_cast<std::uint32_t>(values.integer(name));
}

}  // namespace

std::uint32_t substeps(const registry::ParameterValues& solver, double duration) {
  return inner_steps(duration, solver.real("inner_step"), whole(solver, "max_substeps"));
}
std::uint32_t substeps(const Settings& settings, double duration) {
  return inner_steps(duration, settings.inner_step, settings.max_substeps);
}

Result<void> check_effects(const EffectBlocks& effects) {
  for (const auto& [name, values] : effects)
    if (name != "gravity" && name != "colliders" && name != "wind" && name != "water" && name != "control")
      return usage_error("the solver 'classic' has no effect '" + name + "'", "choose the solver 'exact'");
  return {};
}

Settings make_settings(const registry::ParameterValues& solver, const EffectBlocks& effects) {
  Settings settings;
  settings.inner_step = solver.real("inner_step");
  settings.max_substeps = whole(solver, "max_substeps");
  settings.iterations = whole(solver, "iterations");
  settings.clamped_vertices = whole(solver, "clamped_vertices");
  settings.damping = solver.real("damping");
  settings.shape_stiffness = solver.real("shape_stiffness");
  settings.shape_tip = static_cast<float>(solver.real("shape_tip"));
  settings.sag_free = settings.shape_stiffness > 0 && solver.boolean("sag_free");
  settings.sweep = {.red_black = solver.choice("order") == "red_black",
                    .long_range = solver.boolean("long_range"),
                    .sphere_root = static_cast<float>(solver.real("sphere_root")),
                    .sphere_tip = static_cast<float>(solver.real("sphere_tip"))};
  if (auto gravity = effects.find("gravity"); gravity != effects.end())
    settings.gravity = gravity->second.rgb("acceleration");
  if (auto wind = effects.find("wind"); wind != effects.end())
    settings.streams.push_back(wind::make_wind(wind->second));
  if (auto water = effects.find("water"); water != effects.end()) {
    const water::Water around = water::make_water(water->second);
    settings.streams.push_back(around.current);
    settings.gravity *= 1 - around.buoyancy;
  }
  if (auto contact = effects.find("colliders"); contact != effects.end())
    settings.contact = colliders::make_contact_settings(contact->second);
  return settings;
}

namespace {

/// The pull towards the rest pose carries the weight that the strand has there; the head turns that force along.
glm::dvec3 balancing_force(const Settings& settings, const glm::vec4& rotation) {
  const glm::dvec4 q(rotation);
  return settings.sag_free ? turned(settings.gravity, glm::dvec3(q), q.w) : glm::dvec3(0);
}

wind::Push push_of(const Settings& settings, double time) {
  wind::Push push{.drag = settings.damping};
  for (const wind::Wind& stream : settings.streams) {
    const wind::Push one = wind::push_at(stream, time);
    push.acceleration += one.acceleration;
    push.drag += one.drag;
  }
  return push;
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
  const wind::Push push = push_of(settings, substep.time);
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
