// Powers of cosines and the energy of the cone highlight against closed forms and direct integration.
#define GLM_FORCE_XYZW_ONLY
#include "bsdf/shared/highlight.glslh"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/quadrature.h"

namespace cuticle::bsdf::highlight_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(ConeHighlight, FloatAtLargeExponents_KeepsItsDigits) {
  double worst = 0;
  for (double exponent : {1.0, 7.5, 100.0, 1e4, 1e6})
    for (double widths = 0.01; widths < 5; widths += 0.0137) {
      const float angle = float(std::min(widths / std::sqrt(exponent), 1.5));
      const double truth = std::exp(exponent * 0.5 * std::log1p(-std::pow(std::sin(double(angle)), 2)));
      worst = std::max(worst, std::abs(double(cone_highlight(angle, float(exponent))) / truth - 1));
    }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LE(worst, 1e-5);
}

TEST(ConeHighlight, BeyondARightAngle_IsDark) {
  EXPECT_EQ(cone_highlight(2.0, 1.0), 0);
  EXPECT_EQ(cone_highlight(-3.0f, 50.0f), 0);
  EXPECT_EQ(cone_highlight(0.0, 1e6), 1);
}

/// By adaptive integration, split at the peak.
double direct_energy(double axis, double exponent) {
  const auto f = [&](double theta_i) {
    const double c = std::cos(theta_i - axis);
    return c > 0 ? std::pow(c, exponent) * std::cos(theta_i) : 0.0;
  };
  const Tolerance tolerance{.absolute = 1e-14, .relative = 1e-12, .evaluations = 1000000};
  const double reach = 9 / std::sqrt(exponent), low = std::max({-pi / 2, axis - pi / 2, axis - reach}),
               high = std::min({pi / 2, axis + pi / 2, axis + reach}), peak = std::clamp(axis, low, high);
  return 2 * pi *
         (integrate_adaptive(f, low, peak, tolerance).value + integrate_adaptive(f, peak, high, tolerance).value);
}

TEST(ConeHighlightEnergy, EveryExponentAndAxis_IsTheDirectIntegral) {
  double worst = 0, worst_float = 0;
  for (double exponent : {1.0, 1.5, 2.3, 10.0, 333.0, 1e4, 1e6})
    for (double axis : {-1.5707963, -1.2, -0.3, 0.0, 0.7, 1.57, 2.0}) {
      const double truth = direct_energy(axis, exponent), scale = std::max(truth, 1e-3 / exponent);
      worst = std::max(worst, std::abs(cone_highlight_energy(axis, exponent) - truth) / scale);
      const double narrowed = direct_energy(float(axis), exponent),
                   float_scale = std::max(truth, 0.01 / std::sqrt(exponent));
      const double single = cone_highlight_energy(float(axis), float(exponent));
      worst_float = std::max(worst_float, std::abs(single - narrowed) / float_scale);
    }
  RecordProperty("worst", std::to_string(worst * 1e12));
  RecordProperty("worst_float", std::to_string(worst_float * 1e6));
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(worst_float, 1e-5);
}

TEST(ConeHighlightEnergy, CosineAtNormalIncidence_IsPiSquared) {
  EXPECT_NEAR(cone_highlight_energy(0.0, 1.0), pi * pi, 1e-10);
}

}  // namespace
}  // namespace cuticle::bsdf::highlight_test
