// Strands at rest against known shapes, against a run through time, and against their own balance.
#include <numbers>
#include <random>

#include "sim/classic/test_strands.h"
#include "sim/rod/equilibrium.h"

namespace cuticle::sim::equilibrium_test {
namespace {

using namespace testing;

constexpr double k_g = 9.80665, k_bending = 3.9e9 * 3.5e-5 * 3.5e-5 / (4 * 1300);

double length_of(double gamma) { return std::cbrt(gamma * k_bending / k_g); }

rod::Equilibrium at_rest(const strands::Groom& groom, const std::string& settings, const EffectBlocks& effects,
                         std::span<const PlacedCollider> colliders = {}) {
  return rod::find_equilibrium(groom, settings_of("rod", settings), effects, {.colliders = colliders},
                               silent_progress())
      .value();
}

double worst_residual(const rod::Equilibrium& found) {
  double worst = 0;
  for (const rod::StrandRest& strand : found.strands) worst = std::max(worst, strand.residual);
  return worst;
}

TEST(EquilibriumTruth, Cantilever_IsTheHeavyElastica) {
  // Drop over width of the tip at Gamma 1, 10, 100, 1000 (study/mechanics/reference).
  const std::vector<std::pair<double, double>> truths = {
      {1, 0.124561766442}, {10, 1.066802320433}, {100, 5.888104623327}};
  for (const int links : {32, 128}) {
    strands::Groom groom;
    for (const auto& [gamma, truth] : truths)
      add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(links, length_of(gamma)));
    const rod::Equilibrium found = at_rest(groom, "sag_free=false", gravity());
    std::printf("cantilever, %d links: drop over width off by", links);
    for (std::size_t s = 0; s < truths.size(); ++s) {
      const glm::dvec3 tip(found.positions[groom.offsets[s + 1] - 1]);
      const double error = -tip.y / tip.x / truths[s].second - 1;
      std::printf(" %.1e (%d steps)", error, found.strands[s].steps);
      EXPECT_LT(std::abs(error), links == 32 ? 8e-3 : 5e-4) << truths[s].first;
      EXPECT_TRUE(found.strands[s].is_balanced && found.strands[s].is_stable);
    }
    std::printf("; residual %.1e\n", worst_residual(found));
  }
}

TEST(EquilibriumTruth, LimpStrandOverACylinder_FollowsItForAQuarterTurn) {
  const double length = 0.3, radius = 0.03;
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {1, 0, 0}, uniform_segments(96, length));
  const PlacedCollider cylinder{make_capsule({0, -radius, -0.1}, {0, -radius, 0.1}, radius), {}};
  const rod::Equilibrium found = at_rest(groom, "sag_free=false,young_modulus=1e3,shear_modulus=1e3",
                                         gravity_and_colliders("pearl_radius=0"), std::span(&cylinder, 1));
  const double drop = -double(found.positions.back().y) / length,
               truth = 1 - radius / length * (std::numbers::pi / 2 - 1);
  std::printf(
      "limp strand over a cylinder: drop %.5f of its length, %.5f expected; %.1e m deep, residual %.1e, %d steps\n",
      drop, truth, found.strands[0].depth, found.strands[0].residual, found.strands[0].steps);
  EXPECT_NEAR(drop, truth, 3e-3);
  EXPECT_LT(found.strands[0].depth, 2e-6);
  EXPECT_TRUE(found.strands[0].is_balanced);
}

TEST(Equilibrium, SagFreeGroom_IsAtRestWhereItStands) {
  // The forces of the substeps, which make_hinges balances, leave out a term of second order in a hinge's angle.
  const rod::Equilibrium found = at_rest(curls(), "", gravity());
  for (const rod::StrandRest& strand : found.strands) {
    std::printf("a curl as it stands: residual %.1e after %d steps\n", strand.residual, strand.steps);
    EXPECT_LT(strand.residual, 1e-6);
  }
  const double moved = worst_distance(found.positions, curls().positions);
  std::printf("curls that bend by half a radian at a vertex move by %.1e m\n", moved);
  EXPECT_LT(moved, 4e-4);
}

/// Strands of random length, direction and curl, of which the sharpest has this curvature (1/m).
strands::Groom random_strands(int count, int links, double curvature) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  strands::Groom groom;
  for (int s = 0; s < count; ++s) {
    const double length = 0.02 + 0.1 * (1 + uniform(random)), curl = curvature * uniform(random) * length / links;
    glm::dvec3 direction = glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
    const glm::dvec3 axis = glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
    glm::dvec3 place = 0.09 * direction;
    groom.positions.emplace_back(place);
    for (int i = 0; i < links; ++i) {
      groom.positions.emplace_back(place += direction * (length / links));
      direction = glm::dvec3(glm::rotate(glm::dmat4(1), curl, axis) * glm::dvec4(direction, 0));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}

TEST(Equilibrium, StrandsOnABall_BalanceAndStayOutOfIt) {
  const strands::Groom groom = random_strands(200, 31, 300);
  const PlacedCollider ball{Sphere{{0, 0, 0}, 0.0895}, {}};
  const rod::Equilibrium found =
      at_rest(groom, "sag_free=false", gravity_and_colliders("pearl_radius=0"), std::span(&ball, 1));
  int balanced = 0, stable = 0, steps = 0;
  double depth = 0;
  for (const rod::StrandRest& strand : found.strands) {
    balanced += strand.is_balanced;
    stable += strand.is_stable;
    steps += strand.steps;
    depth = std::max(depth, strand.depth);
  }
  std::printf(
      "%zu strands on a ball: %d balanced to 1e-9, worst residual %.1e, %d stable, %.1f steps a strand, %.1e m deep\n",
      groom.strand_count(), balanced, worst_residual(found), stable, double(steps) / 200, depth);
  EXPECT_EQ(balanced, 200);
  EXPECT_EQ(stable, 200);
  EXPECT_LT(depth, 1e-5);
}

TEST(Equilibrium, RunThroughTime_EndsThere) {
  const strands::Groom groom = random_strands(60, 16, 0);
  const rod::Equilibrium found = at_rest(groom, "sag_free=false", gravity());
  auto solver = make_solver("rod", groom, "sag_free=false,damping=8,double_precision=true", gravity());
  const State state = run_still(*solver, 900, 1.0 / 60);
  const double apart = worst_distance(found.positions, state.positions);
  std::printf("60 strands at rest: within %.1e m of where a run of 15 s ends\n", apart);
  EXPECT_LT(apart, 1e-6);
}

}  // namespace
}  // namespace cuticle::sim::equilibrium_test
