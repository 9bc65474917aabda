#include "lut/fit/positive_fit.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::lut::positive_fit_test {
namespace {

/// Each number by itself, but for `left_out`.
std::vector<PositiveEquation> told(const std::vector<double>& numbers, std::size_t left_out = 1000) {
  std::vector<PositiveEquation> equations;
  for (std::uint32_t k = 0; k < numbers.size(); ++k)
    if (k != left_out) equations.push_back({{{k, 2.0}}, 2 * numbers[k]});
  return equations;
}

TEST(PositiveFit, NumbersThatEquationsSay_AreFound) {
  const std::vector<double> numbers = {0.1, 1, 3, 20, 5, 0.7};
  const auto fit = fit_positive(told(numbers), {2, {1, 1, 3}}, {1e-6, 1e-6});
  ASSERT_TRUE(fit) << fit.error().message;
  for (std::size_t k = 0; k < numbers.size(); ++k) EXPECT_NEAR(fit->numbers[k] / numbers[k], 1, 1e-4) << k;
  EXPECT_LT(fit->cost_after, 1e-6 * fit->cost_before);
}

TEST(PositiveFit, NumberThatNoEquationSays_LiesBetweenItsNeighbours) {
  const auto fit = fit_positive(told({2, 0, 8}, 1), {1, {3, 1, 1}}, {1e-3, 0});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_NEAR(fit->numbers[1], 4, 1e-3);
}

TEST(PositiveFit, PulledTables_LieNearerToOne) {
  const auto free = fit_positive(told({4, 4}), {2, {1, 1, 1}}, {}),
             pulled = fit_positive(told({4, 4}), {2, {1, 1, 1}}, {0, 0, 5, 1});
  ASSERT_TRUE(free && pulled);
  EXPECT_NEAR(free->numbers[0], 4, 1e-3);
  EXPECT_LT(pulled->numbers[0], 3.5);
  EXPECT_GT(pulled->numbers[0], 1);
  EXPECT_NEAR(pulled->numbers[1], 4, 1e-3);
}

TEST(PositiveFit, SumBelowZero_GivesTheLeastNumber) {
  const auto fit = fit_positive(std::vector<PositiveEquation>{{{{0, 1.0}}, -1.0}}, {}, {});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_GT(fit->numbers[0], 0);
  EXPECT_LT(fit->numbers[0], 0.01);
}

TEST(PositiveFit, BadEquations_AreRefusedByName) {
  EXPECT_THAT(fit_positive(std::vector<PositiveEquation>{{{{7, 1.0}}, 1.0}}, {}, {}).error().message,
              testing::HasSubstr("place 7"));
  EXPECT_THAT(fit_positive(std::vector<PositiveEquation>{{{{0, NAN}}, 1.0}}, {}, {}).error().message,
              testing::HasSubstr("equation 0"));
}

}  // namespace
}  // namespace cuticle::lut::positive_fit_test
