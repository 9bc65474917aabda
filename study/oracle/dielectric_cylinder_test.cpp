#include "study/oracle/dielectric_cylinder.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace cuticle::study::oracle::dielectric_cylinder_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Head-on, everything is known by hand: F = ((eta - 1) / (eta + 1))^2, a path of two radii per crossing.
TEST(DielectricCylinder, HeadOnRay_HasTheFresnelAndAbsorptionOfAPlate) {
  const DielectricCylinder cylinder{1.5, glm::dvec3(0.3)};
  EXPECT_NEAR(follow(cylinder, 0, 0, 0).energy.x, 0.04, 1e-15);
  EXPECT_NEAR(follow(cylinder, 0, 0, 1).energy.x, 0.96 * 0.96 * std::exp(-0.6), 1e-15);
  EXPECT_NEAR(follow(cylinder, 0, 0, 2).energy.x, 0.96 * 0.96 * 0.04 * std::exp(-1.2), 1e-15);
  EXPECT_NEAR(std::abs(follow(cylinder, 0, 0, 1).phi), std::numbers::pi, 1e-14);
  EXPECT_NEAR(follow(cylinder, 0, 0, 2).phi, 0, 1e-14);
}

TEST(DielectricCylinder, BrewstersAngle_ReflectsHalfOfThePerpendicularPart) {
  const double eta = 1.6;  // at tan gamma = eta the parallel part vanishes, the other is ((1 - eta^2) / (1 + eta^2))^2
  const double s = (1 - eta * eta) / (1 + eta * eta);
  EXPECT_NEAR(follow({eta, glm::dvec3(0)}, 0, std::sin(std::atan(eta)), 0).energy.x, s * s / 2, 1e-15);
}

TEST(DielectricCylinder, InclinedRay_LeavesAtItsOwnInclination) {
  for (int lobe = 0; lobe < 5; ++lobe)
    EXPECT_NEAR(follow({1.4, glm::dvec3(0)}, 40 * degree, 0.7, lobe).sin_theta, std::sin(40 * degree), 1e-12);
}

TEST(DielectricCylinder, NoAbsorption_OrdersSumToOne) {
  glm::dvec3 sum(0);
  for (int lobe = 0; lobe < 200; ++lobe) sum += lobe_energy({1.55, glm::dvec3(0)}, 50 * degree, lobe, 2000);
  EXPECT_NEAR(sum.x, 1, 1e-6);
}

TEST(DielectricCylinder, Bins_SumToTheLobesEnergy) {
  const DielectricCylinder cylinder{1.55, glm::dvec3(0.2, 1, 5)};
  for (int lobe = 0; lobe < 4; ++lobe) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& bin : azimuthal_bins(cylinder, 30 * degree, lobe, 360, 1 << 16)) sum += bin * degree;
    const glm::dvec3 energy = lobe_energy(cylinder, 30 * degree, lobe, 1 << 16);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], energy[c], 1e-8) << lobe;
  }
}

// R has the closed form A cos(phi/2) / 4; at phi = 0 that is F(0) / 4.
TEST(DielectricCylinder, ReflectedBins_HaveTheClosedFormsValue) {
  const std::vector<glm::dvec3> bins = azimuthal_bins({1.5, glm::dvec3(0)}, 0, 0, 3601, 1 << 18);
  EXPECT_NEAR(bins[1800].x, 0.04 / 4, 1e-6);
}

TEST(DielectricCylinder, RandomWalks_AgreeWithTheDenseWalk) {
  const DielectricCylinder cylinder{1.55, glm::dvec3(0.2, 1, 0)};
  const MonteCarloEnergy walks = random_walks(cylinder, 30 * degree, 4, 1'000'000, 7);
  for (int lobe = 0; lobe < 4; ++lobe) {
    const glm::dvec3 energy = lobe_energy(cylinder, 30 * degree, lobe, 4096);
    const std::size_t i = std::size_t(lobe);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(walks.mean[i][c], energy[c], 4 * walks.standard_error[i][c]) << lobe;
  }
}

}  // namespace
}  // namespace cuticle::study::oracle::dielectric_cylinder_test
