// Corrections of dual scattering: where rows lie, and that the toolkit's own table says what hair does.
#include "bsdf/dual_scattering/corrections.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cuticle::bsdf::dual_scattering::corrections_test {
namespace {

TEST(Corrections, Rows_AreWhereTheAxesSay) {
  EXPECT_EQ(between_depths(1).below, 0);
  EXPECT_EQ(between_depths(1).share, 0);
  for (int k = 0; k + 1 < k_depths; ++k) {
    const double row = double(k) / (k_depths - 1), transmittance = std::exp(std::log(1e-6) * row * row);
    EXPECT_NEAR(between_depths(transmittance).below + between_depths(transmittance).share, k, 1e-6) << k;
  }
  EXPECT_NEAR(between_depths(0).below + between_depths(0).share, k_depths - 1, 1e-6);
  EXPECT_NEAR(between_thicknesses(3).below + between_thicknesses(3).share, 1, 1e-12);
  EXPECT_NEAR(between_albedos(1 - 0.1 * 0.1).share, 0, 1e-12);
  EXPECT_EQ(between_albedos(2).below, 0);
  EXPECT_EQ(between_angles(-1).below + between_angles(-1).share, 0);
  EXPECT_NEAR(between_angles(0.25).below + between_angles(0.25).share, 5, 1e-12);
  EXPECT_NEAR(between_angles(1.01).below + between_angles(1.01).share, k_angles - 1, 1e-12);
  EXPECT_NEAR(between_thicknesses(0).share, 0, 1e-12);
}

TEST(Corrections, BetweenRows_AreLinear) {
  std::vector<double> table(k_numbers);
  for (int f = 0; f < k_factors; ++f)
    for (int t = 0; t < k_thicknesses; ++t)
      for (int a = 0; a < k_albedos; ++a)
        for (int d = 0; d < k_depths; ++d) table[std::size_t(place_of(f, t, a, d))] = 100 * f + 10 * t + a + 0.01 * d;
  for (int f = 0; f < k_factors; ++f)
    for (int a = 0; a < k_albedos; ++a)
      for (int k = 0; k < k_angles; ++k) table[std::size_t(place_of_angle(f, a, k))] = 1000 * f + 10 * a + k;
  const double lost = 0.1 + 1.5 / 4 * (0.95 - 0.1);
  const Corrections found =
      corrections_of(std::span<const double, k_numbers>(table), 1 - lost * lost, std::pow(3.0, 0.25));
  EXPECT_NEAR(found.depths[3].onward, 2.5 + 1.5 + 0.03, 1e-9);
  EXPECT_NEAR(found.depths[7].back, 100 + 2.5 + 1.5 + 0.07, 1e-9);
  EXPECT_NEAR(found.depths[0].diffuse, 200 + 2.5 + 1.5, 1e-9);
  EXPECT_NEAR(found.angles[2].onward, 15 + 2, 1e-9);
  EXPECT_NEAR(found.angles[8].diffuse, 2000 + 15 + 8, 1e-9);
}

TEST(Corrections, OfTheToolkit_ArePositive) {
  for (const Within within : {Within::hair_alone, Within::hair_on_head})
    for (const double number : fitted_corrections(within)) {
      EXPECT_GT(number, 0);
      EXPECT_LT(number, 400);
    }
}

// Light without a direction is most of what dense blond hair lacks; thin or dark hair has next to none.
TEST(Corrections, OfHairAlone_AreLargestForDenseBlondHair) {
  const auto diffuse = [](double albedo, double thickness) {
    return corrections_of(fitted_corrections(Within::hair_alone), albedo, thickness).depths[3].diffuse;
  };
  EXPECT_GT(diffuse(0.95, 9), 3 * diffuse(0.95, 1));
  EXPECT_GT(diffuse(0.95, 9), 3 * diffuse(0.3, 9));
}

// Fibres send light on mostly as it came: with the light behind, hair has more of it than from the side.
TEST(Corrections, OfHairOnAHead_SendLightOn) {
  for (const double albedo : {0.95, 0.6, 0.3}) {
    const Corrections found = corrections_of(fitted_corrections(Within::hair_on_head), albedo, 5);
    EXPECT_GT(found.angles[0].onward, 1.2 * found.angles[k_angles / 2].onward) << albedo;
  }
}

}  // namespace
}  // namespace cuticle::bsdf::dual_scattering::corrections_test
