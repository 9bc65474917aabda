#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shadows/fourier/fourier_map.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"
#include "shadows/fourier/fourier.glslh"

namespace cuticle::shadows::fourier_test {

namespace {

/// Mean |share - step| over depths, for opacity at one depth.
double step_error(std::uint32_t harmonics, double at) {
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const double depth = (i + 0.5) / 1000;
    const auto basis = fourier::integrals(depth, harmonics, 0.0);
    double share = basis.of[0];
    for (std::uint32_t k = 1; k <= harmonics; ++k) {
      const double angle = 2 * std::numbers::pi * k * at;
      share += basis.of[2 * k - 1] * std::cos(angle) + basis.of[2 * k] * std::sin(angle);
    }
    sum += std::abs(share - (depth > at ? 1 : 0)) / 1000;
  }
  return sum;
}

}  // namespace

TEST(FourierIntegrals, AnyDepth_MatchQuadrature) {
  for (const double depth : {0.0, 0.13, 0.5, 0.9, 1.0}) {
    const auto basis = fourier::integrals(float(depth), 16u, 0.0f);
    for (int k = 1; k <= 16; ++k) {
      double c = 0, s = 0;
      for (int i = 0; i < 4000; ++i) {
        const double angle = 2 * std::numbers::pi * k * depth * (i + 0.5) / 4000;
        c += 2 * std::cos(angle) * depth / 4000;
        s += 2 * std::sin(angle) * depth / 4000;
      }
      EXPECT_NEAR(double(basis.of[2 * k - 1]), c, 3e-6) << k;
      EXPECT_NEAR(double(basis.of[2 * k]), s, 3e-6) << k;
    }
  }
}

// A single surface is the hardest thing for the series: its step is approached as 1 / harmonics.
TEST(FourierIntegrals, MoreHarmonics_SharperStep) {
  for (const double at : {0.3, 0.5, 0.8}) {
    EXPECT_LT(step_error(7, at), 0.6 * step_error(2, at));
    EXPECT_LT(step_error(16, at), 0.65 * step_error(7, at));
  }
}

TEST(FourierMap, RandomSlab_FollowsTheExponentialLaw) {
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7);
  const double area = 4e-5 * tests::length_per_area(groom, 0.02, -1);
  const double half = 4e-5 * tests::length_per_area(groom, 0.02, 0.025);
  const std::string set = "accumulate=poisson,filter_texels=3";
  const auto behind = tests::run_shadow("fourier", groom, tests::grid_below(-0.06), set);
  EXPECT_NEAR(tests::mean(behind->values) / std::exp(-0.4 * area), 1, 0.01);
  const auto within = tests::run_shadow("fourier", groom, tests::grid_below(0.025), set);
  EXPECT_NEAR(tests::mean(within->values) / std::exp(-0.4 * half), 1, 0.02);
}

TEST(FourierMap, Smoothing_TakesTheRingingAway) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.05f, 0}, {0.05f, 0.05f, 0}}, 0.005f);
  tests::add_strand(groom, {{-0.05f, 0, 0}, {0.05f, 0, 0}}, 0.005f);
  std::vector<glm::vec3> points;
  for (int i = 0; i <= 100; ++i) points.emplace_back(0, 0.05f - 0.0005f * float(i), 0);
  const auto rise = [&](const std::string& set) {
    float worst = 0, least = 1;
    const auto result = tests::run_shadow("fourier", groom, points, set + ",resolution=64");
    for (const float t : result->values) {
      least = std::min(least, t);
      worst = std::max(worst, t - least);
    }
    return worst;
  };
  EXPECT_LT(rise("harmonics=7,smoothing=2"), 0.3f * rise("harmonics=7"));
}

}  // namespace cuticle::shadows::fourier_test
