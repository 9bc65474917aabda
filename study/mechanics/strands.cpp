#include "study/mechanics/strands.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "sim/rod/equilibrium.h"
#include "study/motion/effect_values.h"

namespace cuticle::study::mechanics {

double length_of(double gamma) { return std::cbrt(gamma * k_bending / k_g); }

strands::Groom groom_of(const std::vector<glm::dvec3>& places) {
  strands::Groom groom;
  for (const glm::dvec3& place : places) groom.positions.emplace_back(place);
  groom.offsets = {0, std::uint32_t(places.size())};
  groom.radii.assign(places.size(), strands::k_default_radius);
  return groom;
}

strands::Groom straight(int links, double length, const glm::dvec3& direction) {
  std::vector<glm::dvec3> places;
  for (int i = 0; i <= links; ++i) places.emplace_back(direction * (length * i / links));
  return groom_of(places);
}

Result<std::unique_ptr<sim::Solver>> solver_of(std::string_view name, const strands::Groom& groom,
                                               const std::string& settings, const Around& around) {
  CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(name));
  CUTICLE_ASSIGN(const registry::ParameterValues values, effect_values(name, settings));
  sim::EffectBlocks effects;
  if (!around.is_weightless) {
    CUTICLE_ASSIGN(effects["gravity"], effect_values("gravity", around.gravity));
  }
  if (around.colliders) {
    CUTICLE_ASSIGN(effects["colliders"], effect_values("colliders", *around.colliders));
  }
  return effect->create(groom, values, effects);
}

Result<sim::State> run_still(sim::Solver& solver, double seconds, double step, const sim::FrameInput& beside) {
  sim::FrameInput input = beside;
  input.duration = step;
  for (int k = 0; k < int(std::ceil(seconds / step - 1e-9)); ++k) CUTICLE_TRY(solver.advance(input));
  return solver.state();
}

Result<AtRest> rest_of(const strands::Groom& groom, const std::string& settings, std::span<const RoundedBox> boxes) {
  CUTICLE_ASSIGN(const registry::ParameterValues values, effect_values("rod", settings));
  sim::EffectBlocks effects;
  CUTICLE_ASSIGN(effects["gravity"], effect_values("gravity", ""));
  CUTICLE_ASSIGN(effects["colliders"], effect_values("colliders", "pearl_radius=0"));
  const std::vector<sim::PlacedCollider> colliders = sim::placed_colliders({.boxes = boxes});
  CUTICLE_ASSIGN(auto found,
                 sim::rod::find_equilibrium(groom, values, effects, {.colliders = colliders}, silent_progress()));
  AtRest rest{std::move(found.positions), 0};
  for (const sim::rod::StrandRest& strand : found.strands) rest.residual = std::max(rest.residual, strand.residual);
  return rest;
}

double fastest(const sim::State& state) {
  double most = 0;
  for (const glm::vec3& velocity : state.velocities) most = std::max(most, glm::length(glm::dvec3(velocity)));
  return most;
}

}  // namespace cuticle::study::mechanics
