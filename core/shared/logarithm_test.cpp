// Logarithms of the shared dialect in float against the standard library in double, and their edges.
#define GLM_FORCE_XYZW_ONLY
#include "core/shared/logarithm.glslh"

#include <cmath>
#include <limits>

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace cuticle::logarithm_test {
namespace {

TEST(PreciseLog, FloatOverTheWholeRange_IsWithinItsBound) {
  double worst = 0;
  for (double exponent = -37.9; exponent < 38; exponent += 0.00021) {
    const float x = std::pow(10.0f, float(exponent));
    if (x != 1) worst = std::max(worst, std::abs(double(precise_log(x)) / std::log(double(x)) - 1));
  }
  RecordProperty("worst", std::to_string(worst * 1e9));
  EXPECT_LE(worst, 3e-7);
}

TEST(PreciseLog, FloatNearOne_KeepsItsRelativeError) {
  for (float x = 0.9f; x < 1.1f; x = std::nextafter(x, 2.0f) + 1e-6f)
    EXPECT_NEAR(double(precise_log(x)), std::log(double(x)), 3e-7 * std::abs(std::log(double(x)))) << x;
}

TEST(LogOneMinus, FloatFromTinyToAlmostOne_IsWithinItsBound) {
  double worst = 0;
  for (float q = 1e-30f; q < 1; q *= 1.0003f)
    worst = std::max(worst, std::abs(double(log_one_minus(q)) / std::log1p(-double(q)) - 1));
  RecordProperty("worst", std::to_string(worst * 1e9));
  EXPECT_LE(worst, 3e-7);
}

TEST(Logarithms, EdgesInEveryPrecision_AreFinite) {
  for (float x : {0.0f, -1.0f, 1e-45f, std::numeric_limits<float>::quiet_NaN()}) EXPECT_TRUE(std::isfinite(precise_log(x)));
  for (double x : {0.0, -1.0}) EXPECT_TRUE(std::isfinite(precise_log(x)));
  EXPECT_TRUE(std::isfinite(log_one_minus(1.0f)) && std::isfinite(log_one_minus(1.0)));
  EXPECT_EQ(log_one_minus(0.0f), 0);
}

TEST(Logarithms, Jet_HasTheirDerivatives) {
  using Jet = ceres::Jet<double, 1>;
  EXPECT_DOUBLE_EQ(precise_log(Jet(0.3, 0)).v[0], 1 / 0.3);
  EXPECT_DOUBLE_EQ(log_one_minus(Jet(0.3, 0)).v[0], -1 / 0.7);
}

}  // namespace
}  // namespace cuticle::logarithm_test
