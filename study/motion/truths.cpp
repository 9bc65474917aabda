#include "study/motion/truths.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "sim/reference/chain_reference.h"
#include "study/motion/effect_values.h"

namespace cuticle::study {
namespace {

using SolverPointer = std::unique_ptr<sim::Solver>;

constexpr double k_g = 9.80665, k_strand = 0.3;
/// Each frame one substep, whatever its duration; nothing holds or slows the hair.
constexpr std::string_view k_one_step = "max_substeps=1,inner_step=",
                           k_free = "damping=0,shape_stiffness=0,clamped_vertices=1";
/// EI / (rho A) of the default fibre, m^4/s^2: E r^2 / (4 rho).
constexpr double k_bending = 3.9e9 * 3.5e-5 * 3.5e-5 / (4 * 1300);

strands::Groom groom_of(std::vector<glm::vec3> places) {
  strands::Groom groom;
  groom.offsets = {0, std::uint32_t(places.size())};
  groom.radii.assign(places.size(), strands::k_default_radius);
  groom.positions = std::move(places);
  return groom;
}
strands::Groom straight(int links, double length, const glm::dvec3& direction) {
  std::vector<glm::vec3> places;
  for (int i = 0; i <= links; ++i) places.emplace_back(direction * (length * i / links));
  return groom_of(std::move(places));
}

Result<SolverPointer> solver_at_one_step(std::string_view name, const strands::Groom& groom, const std::string& settings,
                                const std::string& wind = "", double longest_step = 1) {
  CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(name));
  CUTICLE_ASSIGN(const registry::ParameterValues values, effect_values(name, fmt::format("{},{}{}", settings, k_one_step, longest_step)));
  sim::EffectBlocks effects;
  CUTICLE_ASSIGN(effects["gravity"], effect_values("gravity", ""));
  if (!wind.empty()) {
    CUTICLE_ASSIGN(effects["wind"], effect_values("wind", wind));
  }
  return effect->create(groom, values, effects);
}

Result<sim::State> run_still(sim::Solver& solver, double seconds, double step) {
  sim::FrameInput input;
  input.duration = step;
  for (int k = 0; k < int(std::ceil(seconds / step)); ++k) CUTICLE_TRY(solver.advance(input));
  return solver.state();
}

double mean_of_both(double a, double b) {
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return a;
}

/// Mean period of two swings, from where x of the last vertex crosses 0.
Result<double> period_of(sim::Solver& solver, double step) {
  sim::FrameInput input;
  input.duration = step;
  std::vector<double> crossings;
  double previous = 1;
  for (int k = 1; crossings.size() < 5 && k < 100000; ++k) {
    CUTICLE_TRY(solver.advance(input));
    CUTICLE_ASSIGN(const sim::State state, solver.state());
    const double x = double(state.positions.back().x);
    if (previous * x < 0) crossings.push_back(step * (k - std::abs(x) / (std::abs(x) + std::abs(previous))));
    previous = x;
  }
  if (crossings.size() < 5) return internal_error("study motion: a pendulum that does not swing");
  return (crossings.back() - crossings.front()) / 2;
}

Result<double> pendulum_error(double degrees, double step) {
  const double length = 0.2, angle = degrees * std::numbers::pi / 180;
  const double truth = 2 * std::numbers::pi * std::sqrt(length / k_g) / mean_of_both(1, std::cos(angle / 2));
  CUTICLE_ASSIGN(const SolverPointer solver,
                 solver_at_one_step("exact", straight(1, length, {std::sin(angle), -std::cos(angle), 0}),
                           std::string(k_free) + ",double_precision=true"));
  CUTICLE_ASSIGN(const double period, period_of(*solver, step));
  return period / truth - 1;
}

/// The mode is J0(j sqrt(1 - s / L)) with its first zero j at the root; omega = j / 2 sqrt(g / L).
Result<double> chain_error(double step) {
  constexpr double k_zero = 2.40482555769577;
  const double truth = 2 * std::numbers::pi / (k_zero / 2 * std::sqrt(k_g / k_strand)), link = k_strand / 32;
  std::vector<glm::vec3> places;
  glm::dvec3 place(0);
  for (int i = 0; i <= 32; ++i) {
    const double x = 1e-3 * std::cyl_bessel_j(0.0, k_zero * std::sqrt(1 - i / 32.0)), across = x - place.x;
    if (i > 0) place += glm::dvec3(across, -std::sqrt(link * link - across * across), 0);
    places.emplace_back(place);
  }
  CUTICLE_ASSIGN(const SolverPointer solver,
                 solver_at_one_step("exact", groom_of(std::move(places)), std::string(k_free) + ",double_precision=true"));
  CUTICLE_ASSIGN(const double period, period_of(*solver, step));
  return period / truth - 1;
}

Result<double> wind_error(double step) {
  CUTICLE_ASSIGN(const SolverPointer solver, solver_at_one_step("exact", straight(32, k_strand, {0, -1, 0}), std::string(k_free),
                                                       "velocity=4/0/0,drag=2,gust=0"));
  CUTICLE_ASSIGN(const sim::State state, run_still(*solver, 20, step));
  const glm::dvec3 truth = glm::normalize(glm::dvec3(2 * 4, -k_g, 0));
  double worst = 0;
  for (const glm::vec3& place : state.positions)
    worst = std::max(worst, glm::length(glm::cross(glm::dvec3(place), truth)) / k_strand);
  return worst;
}

/// The head falls from rest; its hair is slanted, and nothing but gravity acts.
Result<double> fall_error(std::string_view name, const std::string& settings, double step) {
  const strands::Groom groom = straight(31, k_strand, glm::normalize(glm::dvec3(1, -1, 0)));
  CUTICLE_ASSIGN(const SolverPointer solver, solver_at_one_step(name, groom, settings, "", step));
  const auto head = [&](double time) {
    return glm::translate(glm::dmat4(1), glm::dvec3(0, -0.5 * k_g * time * time, 0));
  };
  const int frames = int(std::lround(0.5 / step));
  for (int k = 0; k < frames; ++k)
    CUTICLE_TRY(solver->advance({.duration = step, .head_begin = head(k * step), .head_end = head((k + 1) * step)}));
  CUTICLE_ASSIGN(const sim::State state, solver->state());
  const glm::dvec3 fallen(head(frames * step)[3]);
  double worst = 0;
  for (std::size_t i = 0; i < state.positions.size(); ++i)
    worst = std::max(worst, glm::distance(glm::dvec3(state.positions[i]), glm::dvec3(groom.positions[i]) + fallen));
  return worst / k_strand;
}

Result<double> energy_growth(double step) {
  const std::vector<double> segments(31, k_strand / 31);
  CUTICLE_ASSIGN(const SolverPointer solver, solver_at_one_step("exact", straight(31, k_strand, {1, 0, 0}), std::string(k_free)));
  double lowest = 0, growth = 0;  // g L / 2 above the middle of the hanging strand, which is 0 of energy_of's
  for (int k = 0; k < int(2 / step); ++k) {
    CUTICLE_ASSIGN(const sim::State state, run_still(*solver, step, step));
    const double energy =
        sim::energy_of(segments, {state.positions.begin() + 1, state.positions.end()},
                       {state.velocities.begin() + 1, state.velocities.end()}, {0, -k_g, 0}) / (k_g * k_strand);
    growth = std::max(growth, energy - lowest);
    lowest = std::min(lowest, energy);
  }
  return growth;
}

Result<double> elastica_error(double gamma, double truth, double step) {
  const double length = std::cbrt(gamma * k_bending / k_g);
  CUTICLE_ASSIGN(const SolverPointer solver,
                 solver_at_one_step("rod", straight(64, length, {1, 0, 0}), "sag_free=false,damping=5"));
  CUTICLE_ASSIGN(const sim::State state, run_still(*solver, 20, step));
  const glm::dvec3 tip = state.positions.back();
  return -tip.y / tip.x / truth - 1;
}

struct Truth {
  std::string name, solver;
  std::function<Result<double>(double)> error;
};

std::vector<Truth> truths() {
  const std::string fall = "free fall: shape after 0.5 s, over L", limp = "damping=0,young_modulus=0,shear_modulus=0";
  return {{"pendulum, 30 degrees: period", "exact", [](double h) { return pendulum_error(30, h); }},
          {"pendulum, 90 degrees: period", "exact", [](double h) { return pendulum_error(90, h); }},
          {"hanging chain, lowest mode: period", "exact", chain_error},
          {"wind across a chain: off its line, over L", "exact", wind_error},
          {fall, "classic", [](double h) { return fall_error("classic", std::string(k_free), h); }},
          {fall, "exact", [](double h) { return fall_error("exact", std::string(k_free), h); }},
          {fall, "rod", [=](double h) { return fall_error("rod", limp + ",sag_free=false", h); }},
          {"swing: growth of energy in 2 s, over g L", "exact", energy_growth},
          {"heavy elastica, Gamma 10: H/W", "rod", [](double h) { return elastica_error(10, 1.066802320433, h); }},
          {"heavy elastica, Gamma 100: H/W", "rod", [](double h) { return elastica_error(100, 5.888104623327, h); }}};
}

}  // namespace

Result<std::vector<TruthRow>> run_motion_truths(const std::vector<double>& steps) {
  std::vector<TruthRow> rows;
  for (const Truth& truth : truths())
    for (const double step : steps) {
      CUTICLE_ASSIGN(const double error, truth.error(step));
      rows.push_back({truth.name, truth.solver, step, std::max(std::abs(error), 1e-9)});
    }
  return rows;
}

}  // namespace cuticle::study
