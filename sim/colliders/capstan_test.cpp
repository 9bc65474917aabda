// A rope over a horizontal capsule against the capstan's law, e^(friction times angle), the rope's own weight included.
#include <numbers>

#include "sim/chains/test_stability.h"

namespace cuticle::sim::capstan_test {
namespace {

using namespace testing;

constexpr double k_radius = 0.05;

/// A rope of equal links, tangents of the capsule half round it; from a root at the height of its axis a slack loop
/// hangs on one side, a free end on the other.
struct Rope {
  int round, loop, hang;  ///< vertices round the capsule; links down the loop (and up again); links of the free end
  double angle() const { return std::numbers::pi / round; }
  double link() const { return 2 * k_radius * std::tan(angle() / 2); }
};

strands::Groom groom_of(const Rope& rope) {
  const double l = rope.link(), side = k_radius + 1e-6;
  std::vector<glm::dvec2> places;
  for (int i = 0; i <= rope.loop; ++i) places.emplace_back(-side - l, l / 2 - l * i);
  for (int i = rope.loop; i > 0; --i) places.emplace_back(-side, l / 2 - l * i);
  for (int i = 0; i < rope.round; ++i) {
    const double at = rope.angle() * (i + 0.5);
    places.push_back(glm::dvec2(-std::cos(at), std::sin(at)) * (side / std::cos(rope.angle() / 2)));
  }
  for (int i = 1; i <= rope.hang; ++i) places.emplace_back(side, l / 2 - l * i);
  strands::Groom groom;
  for (const glm::dvec2& place : places) groom.positions.emplace_back(place.x, place.y, 0);
  groom.radii.assign(places.size(), strands::k_default_radius);
  groom.offsets = {0, std::uint32_t(places.size())};
  return groom;
}

/// Tension of the free end at which the rope slips, over its weight per length: dT / dphi = R cos phi +
/// friction (T + R sin phi), phi from the side of the loop, whose half hangs there.
double slipping(const Rope& rope, double friction) {
  double tension = rope.loop * rope.link();
  const int steps = 2000;
  const double h = std::numbers::pi / steps;
  const auto slope = [&](double at, double t) {
    return k_radius * std::cos(at) + friction * (t + k_radius * std::sin(at));
  };
  for (int k = 0; k < steps; ++k) tension += h * slope((k + 0.5) * h, tension + h / 2 * slope(k * h, tension));
  return tension;
}
double hanging(const Rope& rope) { return (rope.hang - 0.5) * rope.link(); }

/// How far the free end of limp hair sinks in a second, metres.
double sunk(std::string_view solver, const Rope& rope, double friction, const std::string& more = {}) {
  const strands::Groom groom = groom_of(rope);
  const std::string limp = solver == "rod" ? ",sag_free=false,young_modulus=1e6" : ",shape_stiffness=0";
  auto made = make_solver(solver, groom, "damping=3,clamped_vertices=1" + limp + more,
                          gravity_and_colliders("pearl_radius=0,friction=" + std::to_string(friction)));
  const RoundedBox capsule = make_capsule({0, 0, -0.2}, {0, 0, 0.2}, k_radius);
  for (int k = 0; k < 60; ++k) EXPECT_TRUE(made->advance({.duration = 1.0 / 60, .boxes = {&capsule, 1}}).ok());
  return double(groom.positions.back().y) - double(made->state()->positions.back().y);
}

/// The friction between these that parts slipping from holding.
template <class Slips>
double threshold(double low, double high, double width, const Slips& slips) {
  while (high - low > width) {
    const double middle = (low + high) / 2;
    (slips(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}
double by_the_law(const Rope& rope) {
  return threshold(0, 2, 1e-5, [&](double friction) { return slipping(rope, friction) < hanging(rope); });
}

/// The friction that holds the rope over that of the law, less one.
double error_of(std::string_view solver, const Rope& rope, const std::string& more) {
  const double law = by_the_law(rope);
  const double measured = threshold(0.8 * law, 1.2 * law, 0.025 * law, [&](double friction) {
    return std::abs(sunk(solver, rope, friction, more)) > 5e-3;
  });
  std::printf("capstan, %s, %2d links round it, tensions 1:%.2f, %-16s: holds from friction %.4f, by the law %.4f\n",
              std::string(solver).c_str(), rope.round, hanging(rope) / (rope.loop * rope.link()), more.c_str(),
              measured, law);
  return measured / law - 1;
}

TEST(Capstan, LawOfAWeightlessRope_IsTheExponential) {
  // Links so long that the rope round the capsule weighs next to nothing beside them.
  const Rope heavy{16, 100000, 0};
  for (double friction : {0.1, 0.3, 1.0})
    EXPECT_NEAR(slipping(heavy, friction) / (heavy.loop * heavy.link()), std::exp(friction * std::numbers::pi),
                2e-4 * std::exp(friction * std::numbers::pi));
}

TEST(Capstan, RopeOfExact_SlipsWhereTheLawSaysIt) {
  for (int hang : {20, 30, 40})
    EXPECT_LT(std::abs(error_of("exact", {16, 8, hang}, ",inner_step=0.0020834")), 0.07) << hang;
}

TEST(Capstan, ErrorOfExact_FallsWithTheStep) {
  const Rope rope{32, 16, 60};
  const double coarse = std::abs(error_of("exact", rope, ",inner_step=0.0020834")),
               fine = std::abs(error_of("exact", rope, ",inner_step=0.0010417"));
  EXPECT_LT(coarse, 0.15);
  EXPECT_LT(fine, 0.05);
  EXPECT_LT(fine, coarse / 1.5);
}

TEST(Capstan, RopeOfRod_SlipsWhereTheLawSaysIt) {
  for (int hang : {20, 30, 40})
    EXPECT_LT(std::abs(error_of("rod", {16, 8, hang}, ",inner_step=0.0020834")), 0.04) << hang;
}

TEST(Capstan, RopeOfRod_SlipsThereWithMoreLinksAndShorterStepsToo) {
  for (const char* step : {",inner_step=0.0020834", ",inner_step=0.0010417"})
    EXPECT_LT(std::abs(error_of("rod", {32, 16, 60}, step)), 0.04) << step;
}

}  // namespace
}  // namespace cuticle::sim::capstan_test
