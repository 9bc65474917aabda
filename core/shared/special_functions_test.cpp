// Elementary functions of the shared dialect against mpmath (core/shared/reference/generate_special_functions.py).
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "tests/support/csv_table.h"
#include "core/shared/bessel.glslh"
#include "core/shared/trigonometry.glslh"

namespace cuticle::special_functions_test {
namespace {

using Jet = ceres::Jet<double, 1>;

template <class Real>
Real evaluate(const std::string& name, Real x, Real second) {
  if (name == "sin") return precise_sin(x);
  if (name == "cos") return precise_cos(x);
  if (name == "asin") return safe_asin(x);
  if (name == "acos") return safe_acos(x);
  if (name == "atan2") return precise_atan2(x, second);
  if (name == "exp") return precise_exp(x);
  if (name == "one_minus_exp") return one_minus_exp(x);
  return bessel_i0_scaled(x);
}

/// Errors count against the value; for sine and cosine, which cross 0, against 1.
double error(const std::string& name, double value, double exact) {
  if (exact == 0 || name == "sin" || name == "cos") return std::abs(value - exact);
  return std::abs(value / exact - 1);
}

std::vector<tests::CsvRow> rows_of(const std::string& name) {
  std::vector<tests::CsvRow> rows;
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/core/shared/reference/special_functions.csv"))
    if (row.text("function") == name) rows.push_back(row);
  EXPECT_GT(rows.size(), 40u) << name;
  return rows;
}

/// Into the test report (--gtest_output=xml), in units of 1e-18.
void record(const std::string& name, double largest) {
  ::testing::Test::RecordProperty(name, std::to_string(largest * 1e18));
}

template <class Real>
double largest_error(const std::string& name) {
  double largest = 0;
  for (const tests::CsvRow& row : rows_of(name))
    largest = std::max(largest, error(name, double(evaluate(name, Real(row.number("x")), Real(row.number("second")))),
                                      row.number("value")));
  record(name + (sizeof(Real) == 4 ? "_float" : "_double"), largest);
  return largest;
}

double largest_slope_error(const std::string& name) {
  double largest = 0;
  for (const tests::CsvRow& row : rows_of(name)) {
    const Jet value = evaluate(name, Jet(row.number("x"), 0), Jet(row.number("second")));
    largest = std::max(largest, error(name, value.v[0], row.number("slope")));
  }
  record(name + "_slope", largest);
  return largest;
}

TEST(PreciseSin, InFloatUpTo8000_StaysWithinBound) { EXPECT_LT(largest_error<float>("sin"), 1.2e-7); }
TEST(PreciseCos, InFloatUpTo8000_StaysWithinBound) { EXPECT_LT(largest_error<float>("cos"), 1.2e-7); }
TEST(SafeAsin, InFloat_StaysWithinBound) { EXPECT_LT(largest_error<float>("asin"), 3.2e-7); }
TEST(SafeAcos, InFloat_StaysWithinBound) { EXPECT_LT(largest_error<float>("acos"), 2.0e-7); }
TEST(PreciseAtan2, InFloatAllAround_StaysWithinBound) { EXPECT_LT(largest_error<float>("atan2"), 2.0e-7); }
TEST(PreciseExp, InFloat_StaysWithinBound) { EXPECT_LT(largest_error<float>("exp"), 1.6e-7); }
TEST(PreciseDecay, InFloat_IsTheExponentialOfTheOppositeNumber) {
  for (const tests::CsvRow& row : rows_of("exp")) {
    const float depth = std::max(-float(row.number("x")), 0.0f);
    EXPECT_EQ(precise_decay(depth), precise_exp(-depth)) << depth;
  }
  EXPECT_EQ(precise_decay(std::numeric_limits<float>::quiet_NaN()), 0.0f);
  EXPECT_EQ(precise_decay(std::numeric_limits<float>::infinity()), 0.0f);
}
TEST(OneMinusExp, InFloat_StaysWithinBound) { EXPECT_LT(largest_error<float>("one_minus_exp"), 1.6e-7); }
TEST(BesselI0Scaled, InFloat_StaysWithinBound) { EXPECT_LT(largest_error<float>("bessel_i0_scaled"), 3.0e-7); }

TEST(OneMinusExp, InDouble_StaysWithinBound) { EXPECT_LT(largest_error<double>("one_minus_exp"), 4e-16); }
TEST(BesselI0Scaled, InDouble_StaysWithinBound) { EXPECT_LT(largest_error<double>("bessel_i0_scaled"), 7e-16); }
TEST(Trigonometry, InDouble_IsTheStandardOne) {
  for (const char* name : {"sin", "cos", "asin", "acos", "atan2", "exp"})
    EXPECT_LT(largest_error<double>(name), 3e-16) << name;
}

TEST(BesselI0Scaled, SlopeByJet_MatchesI1MinusI0) { EXPECT_LT(largest_slope_error("bessel_i0_scaled"), 3e-13); }
TEST(OneMinusExp, SlopeByJet_IsTheExponential) {
  for (double t : {1e-9, 0.3, 0.5, 2.0, 30.0}) EXPECT_NEAR(one_minus_exp(Jet(t, 0)).v[0], std::exp(-t), 2e-16) << t;
}
TEST(Trigonometry, SlopesByJet_MatchTheTable) {
  for (const char* name : {"sin", "cos", "asin", "acos", "atan2"}) EXPECT_LT(largest_slope_error(name), 5e-16) << name;
}

TEST(PreciseSin, InFloatOnADenseGrid_StaysWithinBound) {
  double sine = 0, cosine = 0;
  for (int k = -200000; k <= 200000; ++k) {
    const float x = 0.04096f * float(k);
    sine = std::max(sine, std::abs(double(precise_sin(x)) - std::sin(double(x))));
    cosine = std::max(cosine, std::abs(double(precise_cos(x)) - std::cos(double(x))));
  }
  EXPECT_LT(sine, 1.2e-7);
  EXPECT_LT(cosine, 1.2e-7);
}

TEST(BesselI0Scaled, FloatAgainstDoubleOnADenseGrid_StaysWithinBound) {
  double largest = 0;
  for (int k = 0; k <= 300000; ++k) {
    const float x = 2e-4f * float(k);
    largest = std::max(largest, std::abs(double(bessel_i0_scaled(x)) / bessel_i0_scaled(double(x)) - 1));
  }
  EXPECT_LT(largest, 3.5e-7);
}

TEST(SafeAsin, BeyondOne_IsTheRightAngle) {
  for (float x : {1.0f, 1.0000001f, 7.0f, 1e30f}) {
    EXPECT_NEAR(safe_asin(x), 1.5707963f, 2e-7f);
    EXPECT_NEAR(safe_asin(-x), -1.5707963f, 2e-7f);
    EXPECT_NEAR(safe_acos(x), 0.0f, 2e-7f);
    EXPECT_NEAR(safe_acos(-x), 3.1415927f, 4e-7f);
  }
}

TEST(Guards, JetAtTheirEdges_HaveFiniteSlopes) {
  const Jet one(1.0, 0), zero(0.0, 0);
  EXPECT_EQ(safe_asin(one).v[0], 0);
  EXPECT_EQ(safe_acos(-one).v[0], 0);
  EXPECT_EQ(safe_sqrt(zero).v[0], 0);
  EXPECT_EQ(cosine_from_sine(one).v[0], 0);
  EXPECT_EQ(precise_atan2(zero, Jet(0.0)).v[0], 0);
}

TEST(Guards, NotANumber_BecomesTheLowerEdge) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(clamp_to(nan, -2.0f, 3.0f), -2.0f);
  EXPECT_EQ(clamp_positive(nan), 0.0f);
  EXPECT_EQ(safe_sqrt(nan), 0.0f);
  EXPECT_EQ(precise_exp(nan), 0.0f);
}

TEST(PreciseExp, OutsideTheRangeOfFloat_StaysFinite) {
  EXPECT_EQ(precise_exp(-1e30f), 0.0f);
  EXPECT_TRUE(std::isfinite(precise_exp(1e30f)));
}

TEST(PreciseSin, OfHugeArguments_StaysInRange) {
  for (float x = 1.0f; x < 1e38f; x *= 3.7f) {
    EXPECT_LE(std::abs(precise_sin(x)), 1.0f) << x;
    EXPECT_LE(std::abs(precise_cos(x)), 1.0f) << x;
  }
}

TEST(BesselI0Scaled, OfTheLargestFloat_IsFiniteAndPositive) {
  const float value = bessel_i0_scaled(std::numeric_limits<float>::max());
  EXPECT_GT(value, 0.0f);
  EXPECT_LT(value, 1e-18f);
}

}  // namespace
}  // namespace cuticle::special_functions_test
