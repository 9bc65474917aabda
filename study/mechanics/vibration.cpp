// What moves: the modes of a clamped beam and of a hanging chain, and the tip of a folded chain that falls.
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "sim/reference/chain_reference.h"
#include "study/mechanics/experiment.h"
#include "study/mechanics/reference/curves.h"
#include "study/mechanics/strands.h"

namespace cuticle::study::mechanics {
namespace {

using SolverPointer = std::unique_ptr<sim::Solver>;

constexpr int k_links = 32;
constexpr double k_steps = 200;  ///< of a period

double stretch_of(const strands::Groom& groom, const sim::State& state) {
  double most = 0;
  for (const float stretch : sim::stretch(groom, state.positions)) most = std::max(most, std::abs(double(stretch) - 1));
  return most;
}

/// A mode shape at the vertices, and its share in what the strand is off its axis (x).
struct Mode {
  std::vector<double> shape = {};
  double share_in(const sim::State& state) const {
    double sum = 0;
    for (std::size_t i = 1; i < shape.size(); ++i)
      sum += shape[i] * double(state.positions[i].x - state.positions[0].x) * (i + 1 == shape.size() ? 0.5 : 1);
    return sum;
  }
};

struct Swing {
  double period = 0, stretch = 0;
};
/// The mean of three periods of a mode's share, from frame `begin` to `end`; `head` moves the root sideways (m by
/// frame).
Result<Swing> swing(sim::Solver& solver, const strands::Groom& groom, const Mode& mode, double step, int begin, int end,
                    const std::function<double(int)>& head) {
  std::vector<double> crossings;
  double before = 0;
  const auto at = [&](int k) { return glm::translate(glm::dmat4(1), glm::dvec3(head(k), 0, 0)); };
  for (int k = 0; k < end; ++k) {
    CUTICLE_TRY(solver.advance({.duration = step, .head_begin = at(k), .head_end = at(k + 1)}));
    CUTICLE_ASSIGN(const sim::State state, solver.state());
    const double now = mode.share_in(state);
    if (k > begin && before * now < 0)
      crossings.push_back(step * (k + std::abs(before) / (std::abs(before) + std::abs(now))));
    before = now;
    if (crossings.size() == 7) return Swing{(crossings.back() - crossings.front()) / 3, stretch_of(groom, state)};
  }
  return Swing{std::numeric_limits<double>::infinity()};  // it does not swing
}

Result<Outcome> beam_run(double number) {
  const double length = 0.05, root = beam_roots()[std::size_t(number) - 1].value;
  const double frequency = root * root * std::sqrt(k_bending) / (length * length) / (2 * std::numbers::pi);
  const double step = 1 / (frequency * k_steps);
  const strands::Groom groom = straight(k_links, length, {0, -1, 0});
  CUTICLE_ASSIGN(
      const SolverPointer solver,
      solver_of("rod", groom, std::string(k_one_step) + "damping=0,double_precision=true", {.is_weightless = true}));
  Mode mode;
  const double even = (std::cosh(root) + std::cos(root)) / (std::sinh(root) + std::sin(root));
  for (int i = 0; i <= k_links; ++i) {
    const double s = root * i / k_links;
    mode.shape.push_back(std::cosh(s) - std::cos(s) - even * (std::sinh(s) - std::sin(s)));
  }
  const int jolt = int(k_steps) / 2;  // half a period: excites this mode
  const auto head = [&](int k) { return 1e-4 * std::min(1.0, double(k) / jolt); };
  CUTICLE_ASSIGN(const Swing found, swing(*solver, groom, mode, step, jolt, 10 * int(k_steps), head));
  return Outcome{frequency, 1 / found.period, found.stretch};
}

Result<Outcome> chain_run(const std::string& name, const std::string& settings, double number) {
  const double length = 0.3, link = length / k_links, root = chain_roots()[std::size_t(number) - 1].value;
  const double frequency = root / 2 * std::sqrt(k_g / length) / (2 * std::numbers::pi);
  const double step = std::min(1 / (frequency * k_steps), name == "classic" ? 1.0 / 1920 : 1.0);
  Mode mode;
  std::vector<glm::dvec3> places;
  for (int i = 0; i <= k_links; ++i) {
    mode.shape.push_back(std::cyl_bessel_j(0.0, root * std::sqrt(1 - double(i) / k_links)));
    const double across = i ? 1e-4 * (mode.shape[std::size_t(i)] - mode.shape[std::size_t(i) - 1]) : 0;
    places.push_back(i ? places.back() + glm::dvec3(across, -std::sqrt(link * link - across * across), 0)
                       : glm::dvec3(0));
  }
  const strands::Groom groom = groom_of(places);
  CUTICLE_ASSIGN(const SolverPointer solver, solver_of(name, groom, std::string(k_one_step) + "damping=0," + settings));
  CUTICLE_ASSIGN(const Swing found,
                 swing(*solver, groom, mode, step, 0, int(8 / (frequency * step)), [](int) { return 0.0; }));
  return Outcome{frequency, 1 / found.period, found.stretch};
}

// A chain of which one arm hangs from the root and the other is let go of beside it.
constexpr int k_arm = 24;
constexpr double k_chain = 0.3;

std::vector<glm::dvec3> folded() {
  const double link = k_chain / (2 * k_arm + 1);
  std::vector<glm::dvec3> places;
  for (int i = 0; i <= k_arm; ++i) places.emplace_back(0, -link * i, 0);
  for (int i = k_arm; i >= 0; --i) places.emplace_back(link, -link * i, 0);
  return places;
}
constexpr double k_sample = 1.0 / 3840;

/// v^2 / (2 g x) where the tip has fallen by x: the acceleration over g in the mean over the way.
struct Fall {
  std::vector<double> depths, speeds;
  double at(double depth) const {
    for (std::size_t k = 1; k < depths.size(); ++k)
      if (depths[k] >= depth) {
        const double share = (depth - depths[k - 1]) / (depths[k] - depths[k - 1]);
        const double squared = speeds[k - 1] * speeds[k - 1] * (1 - share) + speeds[k] * speeds[k] * share;
        return squared / (2 * k_g * depth);
      }
    return 0;
  }
};
const Fall& reference_fall() {
  static const Fall fall = [] {
    const std::vector<glm::dvec3> places = folded();
    sim::ReferenceChain chain{.places = {places.begin() + 1, places.end()},
                              .velocities = std::vector<glm::dvec3>(places.size() - 1),
                              .lengths = {},
                              .gravity = {0, -k_g, 0}};
    chain.lengths.assign(places.size() - 1, k_chain / (2 * k_arm + 1));
    Fall found;
    while (found.depths.empty() || (found.depths.back() < 0.93 * k_chain && found.depths.size() < 2000)) {
      advance_reference(chain, k_sample / 40, 40);
      found.depths.push_back(-chain.places.back().y);
      found.speeds.push_back(-chain.velocities.back().y);
    }
    return found;
  }();
  return fall;
}

Result<Outcome> fall_run(const std::string& name, const std::string& settings, double share) {
  const strands::Groom groom = groom_of(folded());
  CUTICLE_ASSIGN(const SolverPointer solver, solver_of(name, groom, std::string(k_one_step) + "damping=0," + settings));
  Fall found;
  double stretch = 0;
  while (found.depths.empty() || (found.depths.back() < share * k_chain && found.depths.size() < 2000)) {
    CUTICLE_TRY(solver->advance({.duration = k_sample}));
    CUTICLE_ASSIGN(const sim::State state, solver->state());
    found.depths.push_back(-double(state.positions.back().y));
    found.speeds.push_back(-double(state.velocities.back().y));
    stretch = stretch_of(groom, state);
  }
  return Outcome{reference_fall().at(share * k_chain), found.at(share * k_chain), stretch};
}

const std::string k_stretch = "largest stretch at the end, less 1";

/// Solvers that can be limp, with their settings.
std::vector<std::pair<std::string, std::string>> limp_solvers() {
  return {
      {"classic", std::string(k_free) + "iterations=30"}, {"exact", std::string(k_free)}, {"rod", std::string(k_limp)}};
}

}  // namespace

Experiment clamped_beam(bool) {
  Experiment e{.name = "clamped_beam",
               .title = "Frequencies of a clamped beam",
               .truth = "Euler and Bernoulli: cos x cosh x = -1",
               .x_label = "mode",
               .y_label = "frequency, Hz",
               .residual = k_stretch,
               .curves = {{"beam theory", {}, {}}}};
  for (const ReferencePoint& mode : beam_roots()) {
    e.curves[0].x.push_back(mode.at);
    e.curves[0].y.push_back(mode.value * mode.value * std::sqrt(k_bending) / (0.05 * 0.05) / (2 * std::numbers::pi));
  }
  e.contestants = {{"rod", {{"links", std::to_string(k_links)}}, {1, 2, 3}, beam_run}};
  return e;
}

Experiment hanging_chain(bool) {
  Experiment e{.name = "hanging_chain",
               .title = "Frequencies of a hanging chain",
               .truth = "Bernoulli 1738: zeros of J0",
               .x_label = "mode",
               .y_label = "frequency, Hz",
               .residual = k_stretch,
               .curves = {{"theory", {}, {}}}};
  for (const ReferencePoint& mode : chain_roots()) {
    e.curves[0].x.push_back(mode.at);
    e.curves[0].y.push_back(mode.value / 2 * std::sqrt(k_g / 0.3) / (2 * std::numbers::pi));
  }
  for (const auto& [name, settings] : limp_solvers()) {
    const std::string precise = name == "classic" ? settings : settings + "double_precision=true";
    e.contestants.push_back({name, {{"links", std::to_string(k_links)}}, {1, 2, 3}, [=, name = name](double number) {
                               return chain_run(name, precise, number);
                             }});
  }
  return e;
}

Experiment falling_chain(bool quick) {
  Experiment e{
      .name = "falling_chain",
      .title = "A folded chain let go of: its tip falls faster than g",
      .truth = "Runge-Kutta on the same links; drawn beside it, the chain without a fold (Calkin and March 1989)",
      .x_label = "way that the tip has fallen, over the length",
      .y_label = "mean acceleration, over g",
      .residual = k_stretch,
      .curves = {{"without a fold", {}, {}}, {"49 links", {}, {}}}};
  for (double share = 0.1; share <= 0.901; share += 0.02) {
    e.curves[0].x.push_back(share);
    e.curves[0].y.push_back((2 - share) / (2 - 2 * share));
    e.curves[1].x.push_back(share);
    e.curves[1].y.push_back(reference_fall().at(share * k_chain));
  }
  const std::vector<double> at = some_of({0.2, 0.4, 0.6, 0.7, 0.8}, quick);
  for (const auto& [name, settings] : limp_solvers())
    e.contestants.push_back({name, {}, at, [=, name = name, settings = settings](double share) {
                               return fall_run(name, settings, share);
                             }});
  return e;
}

}  // namespace cuticle::study::mechanics
