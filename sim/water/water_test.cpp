// Hair under water against statics.
#include "sim/classic/test_strands.h"

namespace cuticle::sim::water_test {
namespace {

using namespace testing;

constexpr double k_g = 9.80665;

/// A flexible strand of 0.3 m after 20 s.
State rest_in(const char* solver, const std::string& water) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, {0.6, -0.8, 0}, growing_segments(12, 0.3, 8));
  EffectBlocks effects = gravity();
  effects["water"] = settings_of("water", water);
  const std::string flexible =
      std::string(solver) == "rod" ? "young_modulus=0,shear_modulus=0,clamped_vertices=1,sag_free=false" : k_free;
  return run_still(*make_solver(solver, groom, flexible, effects), 600, 1.0 / 30);
}

double off_line(const State& state, const glm::dvec3& truth) {
  double worst = 0;
  for (const glm::vec3& place : state.positions)
    worst = std::max(worst, glm::distance(glm::dvec3(place), truth * double(glm::length(place))) / 0.3);
  return worst;
}

class Water : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Water, ::testing::Values("classic", "exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(Water, HairLighterThanWater_RisesAndHeavierHangs) {
  for (double density : {650.0, 2600.0}) {
    const State state = rest_in(GetParam(), "current=0/0/0,density=1300,fibre_density=" + std::to_string(density));
    EXPECT_LT(off_line(state, {0, density < 1300 ? 1 : -1, 0}), 1e-3) << density;
  }
}

TEST_P(Water, SteadyCurrent_TiltsByDragOverTheRemainingWeight) {
  const State state = rest_in(GetParam(), "current=0.2/0/0.1,swell=0,drag=10,density=1000,fibre_density=1300");
  const double weight = k_g * (1 - 1000.0 / 1300);
  const double worst = off_line(state, glm::normalize(glm::dvec3(2, -weight, 1)));
  std::printf("%s in a current: farthest from the line tan phi = drag U / (g (1 - buoyancy)): %.1e of the length\n",
              GetParam(), worst);
  EXPECT_LT(worst, 1e-3);
}

TEST_P(Water, OfItsOwnDensityAndStill_HairStaysWhereItIs) {
  const State state = rest_in(GetParam(), "current=0/0/0,density=1300,fibre_density=1300");
  EXPECT_LT(off_line(state, {0.6, -0.8, 0}), 1e-2);  // nothing brings it back: rounding moves it in 9,600 substeps
}

}  // namespace
}  // namespace cuticle::sim::water_test
