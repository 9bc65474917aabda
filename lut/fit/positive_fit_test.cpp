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

Result<PositiveFit> fitted(const std::vector<PositiveEquation>& equations, std::vector<PositiveShape> shapes = {{}},
                           PositiveSmoothing smoothing = {}) {
  return fit_positive(equations, shapes, smoothing);
}

TEST(PositiveFit, NumbersThatEquationsSay_AreFound) {
  const std::vector<double> numbers = {0.1, 1, 3, 20, 5, 0.7};
  const auto fit = fitted(told(numbers), {{2, {1, 1, 3}}}, {1e-6, 1e-6});
  ASSERT_TRUE(fit) << fit.error().message;
  for (std::size_t k = 0; k < numbers.size(); ++k) EXPECT_NEAR(fit->numbers[k] / numbers[k], 1, 1e-4) << k;
  EXPECT_LT(fit->cost_after, 1e-6 * fit->cost_before);
}

TEST(PositiveFit, NumberThatNoEquationSays_LiesBetweenItsNeighbours) {
  const auto fit = fitted(told({2, 0, 8}, 1), {{1, {3, 1, 1}}}, {1e-3, 0});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_NEAR(fit->numbers[1], 4, 1e-3);
}

TEST(PositiveFit, PulledTables_LieNearerToOne) {
  const auto free = fitted(told({4, 4}), {{2}}), pulled = fitted(told({4, 4}), {{2, {1, 1, 1}, 1}}, {0, 0, 5});
  ASSERT_TRUE(free && pulled);
  EXPECT_NEAR(free->numbers[0], 4, 1e-3);
  EXPECT_LT(pulled->numbers[0], 3.5);
  EXPECT_GT(pulled->numbers[0], 1);
  EXPECT_NEAR(pulled->numbers[1], 4, 1e-3);
}

// What a table of products says of each of its factors is their ratios; the pull says the rest.
TEST(PositiveFit, ProductsOfTwoTables_AreFound) {
  const std::vector<double> rows = {0.5, 2, 6}, columns = {1, 0.3, 4, 9};
  std::vector<PositiveEquation> equations;
  for (std::uint32_t r = 0; r < rows.size(); ++r)
    for (std::uint32_t c = 0; c < columns.size(); ++c)
      equations.push_back({{{r, 2.0, 3 + c}}, 2 * rows[r] * columns[c]});
  const auto fit = fitted(equations, {{1, {1, 1, 3}}, {1, {1, 1, 4}, 1}}, {0, 0, 1e-4});
  ASSERT_TRUE(fit) << fit.error().message;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      EXPECT_NEAR(fit->numbers[r] * fit->numbers[3 + c] / (rows[r] * columns[c]), 1, 1e-3) << r << ' ' << c;
}

TEST(PositiveFit, SumBelowZero_GivesTheLeastNumber) {
  const auto fit = fitted({{{{0, 1.0}}, -1.0}});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_GT(fit->numbers[0], 0);
  EXPECT_LT(fit->numbers[0], 0.01);
}

TEST(PositiveFit, BadEquations_AreRefusedByName) {
  EXPECT_THAT(fitted({{{{7, 1.0}}, 1.0}}).error().message, testing::HasSubstr("place 7"));
  EXPECT_THAT(fitted({{{{0, 1.0, 9}}, 1.0}}).error().message, testing::HasSubstr("place 9"));
  EXPECT_THAT(fitted({{{{0, NAN}}, 1.0}}).error().message, testing::HasSubstr("equation 0"));
}

}  // namespace
}  // namespace cuticle::lut::positive_fit_test
