// The rod against truths of mechanics.
#include <numbers>

#include "sim/classic/test_strands.h"

namespace cuticle::sim::rod_truth_test {
namespace {

using namespace testing;

constexpr double k_g = 9.80665;
/// EI / (rho A) of the default fibre, E r^2 / (4 rho), and GJ / (rho A), G r^2 / (2 rho).
constexpr double k_bending = 3.9e9 * 3.5e-5 * 3.5e-5 / (4 * 1300), k_twisting = 0.9e9 * 3.5e-5 * 3.5e-5 / (2 * 1300);
const std::string k_straight = "sag_free=false,damping=5";

std::string one_step(const std::string& more) { return more + ",inner_step=100,max_substeps=1"; }

/// Length of a rod of which rho g A L^3 / (EI) is `gamma`.
double length_of(double gamma) { return std::cbrt(gamma * k_bending / k_g); }

/// The discrete truth: angles of a planar chain of hinges (2 EI / l at the clamp, EI over the mean of two links) that
/// starts horizontal, under the weight of half the adjacent links at each vertex and a load at the tip; Newton's method
/// on the energy, the load raised in steps. EI / (rho A) = 1 and g = 1 in these units.
std::vector<double> hinge_chain(const std::vector<double>& lengths, double weight, double load) {
  const std::size_t n = lengths.size();
  std::vector<double> angles(n, 0.0), stiffness(n + 1, 0.0), below(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) stiffness[i] = i ? 2 / (lengths[i - 1] + lengths[i]) : 2 / lengths[0];
  for (std::size_t i = n; i-- > 0;)
    below[i] = (i + 1 < n ? below[i + 1] : load) + weight * (lengths[i] + (i + 1 < n ? lengths[i + 1] : 0)) / 2;
  for (int step = 1; step <= 40; ++step)
    for (int iteration = 0; iteration < 40; ++iteration) {
      std::vector<double> pivot(n), move(n);
      const double share = step / 40.0;
      for (std::size_t i = 0; i < n; ++i) {
        const double above = angles[i] - (i ? angles[i - 1] : 0), under = i + 1 < n ? angles[i + 1] - angles[i] : 0;
        move[i] = -(stiffness[i] * above - stiffness[i + 1] * under * (i + 1 < n) -
                    share * below[i] * lengths[i] * std::cos(angles[i]));
        pivot[i] = stiffness[i] + stiffness[i + 1] * (i + 1 < n) + share * below[i] * lengths[i] * std::sin(angles[i]);
        if (i) pivot[i] -= stiffness[i] * stiffness[i] / pivot[i - 1];
        if (i) move[i] += stiffness[i] / pivot[i - 1] * move[i - 1];
      }
      for (std::size_t i = n; i-- > 0;)
        angles[i] += move[i] =
            std::clamp((move[i] + (i + 1 < n ? stiffness[i + 1] * move[i + 1] : 0)) / pivot[i], -0.3, 0.3);
    }
  return angles;
}
/// Width and drop of the chain's first `links` links.
std::array<double, 2> extent(const std::vector<double>& lengths, const std::vector<double>& angles, std::size_t links) {
  std::array<double, 2> sum{};
  for (std::size_t i = 0; i < links; ++i) {
    sum[0] += lengths[i] * std::cos(angles[i]);
    sum[1] += lengths[i] * std::sin(angles[i]);
  }
  return sum;
}

TEST(HingeChain, HasTheClosedFormsAsItsLimits) {
  // Heavy elastica H / W at Gamma 1, 10, 100 and Mattiasson's tip-loaded drop / L at 1, 5, 10.
  const std::vector<double> lengths = uniform_segments(400, 1);
  for (const auto& [gamma, truth] :
       {std::pair(1.0, 0.124561766442), std::pair(10.0, 1.066802320433), std::pair(100.0, 5.888104623327)}) {
    const auto [width, drop] = extent(lengths, hinge_chain(lengths, gamma, 0), 400);
    EXPECT_NEAR(drop / width / truth, 1, 1e-4) << gamma;
  }
  for (const auto& [load, truth] :
       {std::pair(1.0, 0.301720773800), std::pair(5.0, 0.713791523612), std::pair(10.0, 0.810609024880)})
    EXPECT_NEAR(extent(lengths, hinge_chain(lengths, 0, load), 400)[1] / truth, 1, 1e-4) << load;
}

TEST(RodTruth, HeavyElastica_IsTheDiscreteOneAtAnyStep) {
  const std::vector<double> gammas = {1, 10, 100, 1000};
  for (int links : {16, 32})
    for (double step : {1.0 / 480, 1.0 / 60, 0.1, 1.0}) {
      strands::Groom groom;
      for (double gamma : gammas) add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(links, length_of(gamma)));
      auto solver = make_solver("rod", groom, one_step(k_straight), gravity());
      const State state = run_still(*solver, int(12 / std::min(step, 0.1)), step);
      std::printf("heavy elastica, %d links, steps of %.4f s: H/W off by", links, step);
      for (std::size_t s = 0; s < gammas.size(); ++s) {
        const std::vector<double> unit = uniform_segments(links, 1);
        const auto [width, drop] = extent(unit, hinge_chain(unit, gammas[s], 0), std::size_t(links));
        const glm::vec3 tip = state.positions[groom.offsets[s + 1] - 1];
        const double error = -double(tip.y) / double(tip.x) / (drop / width) - 1;
        std::printf("  %.1e", error);
        // Short steps of long rods of long links: a step's weight is few units of the places' last digit.
        EXPECT_LT(std::abs(error), step < 0.01 && links == 16 && gammas[s] > 100 ? 1.5e-4 : 5e-5)
            << gammas[s] << " " << step;
      }
      std::printf("  (Gamma 1, 10, 100, 1000)\n");
    }
}

TEST(RodTruth, TipLoadedElastica_IsTheDiscreteOne) {
  // The load hangs at the tip by a link thirty times as long as the rod.
  const double length = 0.02;
  std::vector<double> unit = uniform_segments(16, 1), segments;
  unit.push_back(30);
  for (double part : unit) segments.push_back(part * length);
  for (double step : {1.0 / 480}) {
    strands::Groom groom;
    add_straight(groom, {0, 0, 0}, {1, 0, 0}, segments);
    const State state =
        run_still(*make_solver("rod", groom, one_step(k_straight), gravity()), int(20 / std::min(step, 0.1)), step);
    const auto [width, drop] = extent(unit, hinge_chain(unit, k_g * std::pow(length, 3) / k_bending, 0), 16);
    const double off =
        std::hypot(double(state.positions[16].x) / length - width, -double(state.positions[16].y) / length - drop);
    std::printf("tip-loaded elastica (%.2f P L^2 / EI), steps of %.4f s: tip off by %.1e L\n",
                30 * k_g * std::pow(length, 3) / k_bending, step, off);
    EXPECT_LT(off, 4e-5);
  }
}

/// A helix of 3 turns: curvature and torsion in every direction.
strands::Groom helix() {
  strands::Groom groom;
  for (int i = 0; i <= 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 16;
    groom.positions.emplace_back(0.01 * std::cos(angle), -0.002 * i, 0.01 * std::sin(angle));
  }
  groom.radii.assign(49, strands::k_default_radius);
  groom.offsets = {0, 49};
  return groom;
}

double lost(const strands::Groom& groom, const State& state, const glm::dmat4& head = glm::dmat4(1)) {
  double worst = 0;
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    worst = std::max(
        worst, glm::distance(glm::dvec3(head * glm::dvec4(groom.positions[i], 1)), glm::dvec3(state.positions[i])));
  return worst;
}

TEST(RodTruth, CurvedRestShape_StaysWithoutForces) {
  for (double step : {1.0 / 480, 1.0 / 30, 1.0}) {
    const State state = run_still(*make_solver("rod", helix(), one_step("damping=0"), {}), 100, step);
    std::printf("a helix without forces, steps of %.4f s: off by %.1e m\n", step, lost(helix(), state));
    EXPECT_LT(lost(helix(), state), 4e-6) << step;
  }
}

TEST(RodTruth, SagFreeGroom_HoldsItsShapeAgainstGravity) {
  strands::Groom slanted;
  add_straight(slanted, {0, 0, 0}, glm::normalize(glm::dvec3(1, 0.5, 0.2)), growing_segments(20, 0.08, 4));
  for (const strands::Groom& groom : {helix(), slanted})
    for (double step : {1.0 / 480, 1.0 / 30}) {
      const State held = run_still(*make_solver("rod", groom, one_step("damping=2"), gravity()), int(3 / step), step),
                  sagging = run_still(*make_solver("rod", groom, one_step("damping=2,sag_free=false"), gravity()),
                                      int(3 / step), step);
      std::printf("under gravity for 3 s, steps of %.4f s: moved by %.1e m, without the rest shape's solve %.1e m\n",
                  step, lost(groom, held), lost(groom, sagging));
      EXPECT_LT(lost(groom, held), 2e-6) << step;
      EXPECT_GT(lost(groom, sagging), 1e-3) << step;
    }
}

TEST(RodTruth, TurnedHead_TakesTheCurvedShapeAlong) {
  auto solver = make_solver("rod", helix(), "damping=4", {});
  const auto head = [](int k) {
    return glm::rotate(glm::dmat4(1), 2.0 * std::min(1.0, k / 30.0), glm::normalize(glm::dvec3(1, 2, 3)));
  };
  for (int k = 0; k < 240; ++k)
    ASSERT_TRUE(
        solver->advance({.duration = 1.0 / 60, .head_begin = head(k), .head_end = head(k + 1), .colliders = {}}).ok());
  const double off = lost(helix(), *solver->state(), head(240));
  std::printf("a helix after a turn of 2 rad: off by %.1e m\n", off);
  EXPECT_LT(off, 8e-5);
}

TEST(RodTruth, ArcLoadedAcrossItsPlane_SagsByBendingAndTwist) {
  // A quarter circle of radius R lies in the horizontal plane; small weights. Castigliano: deflection of the tip = the
  // sum of M m / EI + T t / GJ along the arc, M and T of the weight beyond, m and t of a unit load at the tip.
  const double radius = 0.05, weight = 0.01;
  const int links = 64;
  strands::Groom groom;
  for (int i = 0; i <= links; ++i) {
    const double angle = std::numbers::pi / 2 * i / links;
    groom.positions.emplace_back(radius * std::sin(angle), 0, radius * (1 - std::cos(angle)));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  groom.offsets = {0, std::uint32_t(groom.positions.size())};
  double truth = 0;
  const int pieces = 2000;
  for (int k = 0; k < pieces; ++k) {
    const double at = std::numbers::pi / 2 * (k + 0.5) / pieces, left = std::numbers::pi / 2 - at;
    // Of a load at the angle a beyond: bending R sin a, torsion R (1 - cos a).
    const double bending = radius * radius * weight * (1 - std::cos(left)),
                 torsion = radius * radius * weight * (left - std::sin(left));
    truth += (bending * radius * std::sin(left) / k_bending + torsion * radius * (1 - std::cos(left)) / k_twisting) *
             radius * std::numbers::pi / 2 / pieces;
  }
  const std::string pull = "acceleration=0/-" + std::to_string(weight) + "/0";
  const State state = run_still(*make_solver("rod", groom, "sag_free=false,damping=5,double_precision=true",
                                             {{"gravity", settings_of("gravity", pull)}}),
                                1200, 1.0 / 60);
  const double sag = -double(state.positions.back().y);
  std::printf("quarter arc across its plane: tip sags by %.4e m, by beam theory %.4e m (%.2e off)\n", sag, truth,
              sag / truth - 1);
  EXPECT_NEAR(sag / truth, 1, 4e-4);
}

TEST(RodTruth, UprightRod_BucklesPastItsCriticalWeight) {
  // rho g A L^3 / (EI) = 7.8373; a slight lean is amplified below, and falls over above.
  for (double gamma : {6.5, 9.5}) {
    strands::Groom groom;
    add_straight(groom, {0, 0, 0}, glm::normalize(glm::dvec3(1e-3, 1, 0)), uniform_segments(32, length_of(gamma)));
    const State state = run_still(*make_solver("rod", groom, k_straight, gravity()), 1800, 1.0 / 60);
    const double lean = double(state.positions.back().x) / length_of(gamma);
    std::printf("upright rod, Gamma %.1f: its tip leans by %.3g of its length\n", gamma, lean);
    if (gamma < 7.837)
      EXPECT_LT(lean, 0.02);
    else
      EXPECT_GT(lean, 0.2);
  }
}

TEST(RodTruth, ClampedBeam_SwingsAtItsLowestFrequency) {
  // omega = 1.87510406871196^2 sqrt(EI / (rho A)) / L^2, without gravity, after a jolt of the root.
  const double length = 0.05, truth = 2 * std::numbers::pi /
                                      (std::pow(1.87510406871196, 2) * std::sqrt(k_bending) / (length * length));
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {0, -1, 0}, uniform_segments(32, length));
  const double step = truth / 800;
  char number[32];
  std::snprintf(number, sizeof number, "%.17g", step);
  auto solver = make_solver("rod", groom, "damping=0,double_precision=true,inner_step=" + std::string(number), {});
  std::vector<double> crossings;
  double previous = 0;
  for (int k = 0; crossings.size() < 6 && k < 8000; ++k) {
    const auto at = [&](int i) {
      return glm::translate(glm::dmat4(1), glm::dvec3(1e-4 * std::min(1.0, i / 400.0), 0, 0));
    };
    ASSERT_TRUE(solver->advance({.duration = step, .head_begin = at(k), .head_end = at(k + 1), .colliders = {}}).ok());
    const State state = solver->state().value();
    const double x = double(state.positions.back().x - state.positions.front().x);
    if (k > 800 && previous * x < 0) crossings.push_back(step * (k - std::abs(x) / (std::abs(x) + std::abs(previous))));
    previous = x;
  }
  ASSERT_EQ(crossings.size(), 6u);
  const double error = (crossings[4] - crossings[0]) / 2 / truth - 1;
  std::printf("clamped beam of 32 links: relative error of the lowest period %.1e\n", error);
  EXPECT_LT(std::abs(error), 0.01);
}

}  // namespace
}  // namespace cuticle::sim::rod_truth_test
