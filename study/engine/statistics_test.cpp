#include "study/engine/statistics.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace cuticle::study::statistics_test {
namespace {

CostAndError exactly(double cost, double error) { return {{cost, cost, cost}, {error, error, error}}; }

TEST(Summarise, NormalErrors_TheIntervalHoldsTheMeanAsOftenAsItSays) {
  std::mt19937 generator(7);
  std::exponential_distribution<double> drawn(2);  // mean 0.5, root of the mean square sqrt(0.5)
  int arithmetic = 0, square = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<double> errors(200);
    for (double& error : errors) error = drawn(generator);
    const Interval mean = summarise(errors, Mean::arithmetic).mean, rms = summarise(errors, Mean::root_mean_square).mean;
    arithmetic += mean.low < 0.5 && 0.5 < mean.high;
    square += rms.low < std::sqrt(0.5) && std::sqrt(0.5) < rms.high;
  }
  EXPECT_NEAR(arithmetic, 945, 25);
  EXPECT_NEAR(square, 915, 40);  // squares are skewed
}

TEST(Summarise, KnownValues_QuantilesHalvesAndNoNaN) {
  const double errors[] = {1, -2, 3, std::numeric_limits<double>::quiet_NaN(), 5};
  const ErrorSummary all = summarise(errors, Mean::arithmetic);
  EXPECT_EQ(all.items, 4u);
  EXPECT_DOUBLE_EQ(all.mean.value, 2.75);
  EXPECT_EQ(all.maximum, 5);
  EXPECT_EQ(summarise(errors, Mean::arithmetic, Items::choosing).mean.value, 3);
  EXPECT_EQ(summarise(errors, Mean::arithmetic, Items::judging).mean.value, 2);
  EXPECT_EQ(summarise({}, Mean::arithmetic).items, 0u);
}

TEST(MedianInterval, OrderStatistics_AreThoseOfTheBinomial) {
  // Nine samples: the second and the eighth hold the median with 96.1 %; five: the ends, with 93.8 %.
  const Interval nine = median_interval({9, 1, 8, 2, 7, 3, 6, 4, 5});
  EXPECT_EQ(nine.value, 5);
  EXPECT_EQ(nine.low, 2);
  EXPECT_EQ(nine.high, 8);
  const Interval five = median_interval({5, 1, 4, 2, 3});
  EXPECT_EQ(five.low, 1);
  EXPECT_EQ(five.high, 5);
  EXPECT_TRUE(std::isinf(median_interval({3}).high));
}

TEST(ParetoFront, Points_AreOnItOrSurelyBeaten) {
  std::vector<CostAndError> points = {exactly(1, 9), exactly(2, 4), exactly(3, 5), exactly(4, 1)};
  points[2].error = {5, 3, 7};  // overlaps with that of the second
  const auto places = pareto_front(points);
  EXPECT_TRUE(places[0].on_front && places[1].on_front && places[3].on_front);
  EXPECT_FALSE(places[2].on_front);
  EXPECT_FALSE(places[2].surely_beaten);
  points[2].error = {5, 4.5, 7};
  EXPECT_TRUE(pareto_front(points)[2].surely_beaten);
}

TEST(Choices, Limits_GiveTheCheapestAndTheMostExact) {
  const std::vector<CostAndError> points = {exactly(1, 9), exactly(2, 4), exactly(4, 1)};
  EXPECT_EQ(cheapest_for(points, 4), 1u);
  EXPECT_FALSE(cheapest_for(points, 0.5));
  EXPECT_EQ(most_accurate_within(points, 3), 1u);
  EXPECT_FALSE(most_accurate_within(points, 0.5));
}

TEST(Knee, AFrontThatBends_IsFoundAtTheBend) {
  const std::vector<CostAndError> points = {exactly(1, 1), exactly(2, 0.1), exactly(10, 0.05), exactly(100, 0.03)};
  EXPECT_EQ(knee(points), 1u);
  EXPECT_FALSE(knee(std::span(points).first(2)));
}

TEST(ScalingExponent, APowerWithNoise_IsWithinItsError) {
  std::vector<double> x, y;
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, 0.1);
  for (double value = 1; value < 1000; value *= 2) {
    x.push_back(value);
    y.push_back(5 * std::pow(value, -2) * std::exp(noise(generator)));
  }
  const Exponent exponent = *scaling_exponent(x, y);
  EXPECT_NEAR(exponent.value, -2, 3 * exponent.standard_error);
  EXPECT_LT(exponent.standard_error, 0.03);
  EXPECT_FALSE(scaling_exponent(std::vector<double>{1, 1, 1}, std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace cuticle::study::statistics_test
