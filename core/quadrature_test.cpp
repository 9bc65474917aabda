#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/quadrature.h"
#include "tests/support/csv_table.h"

namespace cuticle::quadrature_test {
namespace {

TEST(GaussLegendre, TableOrders_MatchMpmath) {
  int order = 0, index = 0;
  QuadratureRule rule;
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/core/reference/gauss_legendre.csv")) {
    if (int(row.whole("order")) != order) {
      order = int(row.whole("order"));
      index = 0;
      rule = gauss_legendre(order);
    }
    EXPECT_NEAR(rule.nodes[std::size_t(index)], row.number("node"), 4e-16) << order;
    EXPECT_NEAR(rule.weights[std::size_t(index)], row.number("weight"), 2e-15) << order;
    ++index;
  }
}

TEST(GaussLegendre, AnyOrder_IntegratesItsHighestPower) {
  for (int order = 1; order <= 40; ++order) {
    const double power = 2 * order - 2;
    const double sum = integrate(gauss_legendre(order), -1, 1, [&](double x) { return std::pow(x, power); });
    EXPECT_NEAR(sum, 2 / (power + 1), 2e-15) << order;
  }
}

TEST(GaussLegendre, AThousandPoints_WeightsSumToTwo) {
  double sum = 0;
  for (double w : gauss_legendre(1000).weights) sum += w;
  EXPECT_NEAR(sum, 2, 1e-12);
}

TEST(IntegrateAdaptive, SmoothIntegrand_MeetsItsTolerance) {
  const Integral sum = integrate_adaptive([](double x) { return std::exp(-x * x); }, -8, 8);
  EXPECT_TRUE(sum.converged);
  EXPECT_NEAR(sum.value, std::sqrt(std::numbers::pi), 1e-13);
  EXPECT_LE(std::abs(sum.value - std::sqrt(std::numbers::pi)), sum.error + 1e-15);
}

TEST(IntegrateAdaptive, InverseRootAtTheEnd_Converges) {
  const Integral sum = integrate_adaptive([](double x) { return 1 / std::sqrt(x); }, 0, 1, {.relative = 1e-7});
  EXPECT_TRUE(sum.converged);
  EXPECT_NEAR(sum.value, 2, 1e-6);
}

TEST(IntegrateAdaptive, SpikeInsideAWideRange_IsResolved) {
  const Integral sum = integrate_adaptive([](double x) { return 1 / (1 + 1e8 * x * x); }, -1, 1.5);
  EXPECT_NEAR(sum.value, (std::atan(1e4) + std::atan(1.5e4)) / 1e4, 1e-13);
}

TEST(IntegrateAdaptive, ReversedLimits_ChangeTheSign) {
  const auto cosine = [](double x) { return std::cos(x); };
  EXPECT_NEAR(integrate_adaptive(cosine, 1, 0).value, -std::sin(1.0), 1e-14);
}

TEST(IntegrateAdaptive, TooFewEvaluations_SaysThatItDidNotConverge) {
  const Integral sum = integrate_adaptive([](double x) { return std::sin(1 / x); }, 0, 1, {.relative = 1e-12, .evaluations = 45});
  EXPECT_FALSE(sum.converged);
  EXPECT_LE(sum.evaluations, 45u);
}

TEST(IntegrateAdaptive, EmptyRange_IsZero) {
  const Integral sum = integrate_adaptive([](double x) { return x; }, 2, 2);
  EXPECT_TRUE(sum.converged);
  EXPECT_EQ(sum.value, 0);
}

}  // namespace
}  // namespace cuticle::quadrature_test
