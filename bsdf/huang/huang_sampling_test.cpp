// Samples of the microfacet model against their density: its integral, chi-square, weights.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "bsdf/model.h"

namespace cuticle::bsdf::huang_sampling_test {
namespace {

constexpr double pi = std::numbers::pi;
const Model& model() { return **find_model("huang"); }

struct Case {
  const char* settings;
  double theta_o, phi_o, h;
};
class HuangSampling : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Fibres, HuangSampling,
                         testing::Values(Case{"roughness=0.3,samples=64", 0.5, 0, 0},
                                         Case{"roughness=0.08,tilt_deg=8,aspect=0.5,samples=64", -0.9, 0.7, 0},
                                         Case{"roughness=0.15,field=near,tilt_deg=5,samples=64", 0.3, 0.2, 0.6}));

constexpr int thetas = 16, phis = 24, inner = 6;

/// What each bin holds of the density, over all lobes or one.
std::vector<double> expected_shares(const Case& c, int lobe) {
  std::vector<Point> points;
  for (int i = 0; i < thetas * inner; ++i)
    for (int k = 0; k < phis * inner; ++k)
      points.push_back({.theta_i = ((i + 0.5) / (thetas * inner) - 0.5) * pi,
                        .theta_o = c.theta_o,
                        .phi = ((k + 0.5) / (phis * inner) - 0.5) * 2 * pi,
                        .h = c.h,
                        .phi_o = c.phi_o});
  std::vector<glm::dvec3> pdf(points.size());
  EXPECT_TRUE(
      evaluate(model(), *parse_settings(model(), "", c.settings), Precision::f64, {Quantity::pdf, lobe, points}, pdf)
          .ok());
  std::vector<double> shares(thetas * phis);
  const double cell = pi / (thetas * inner) * 2 * pi / (phis * inner);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const std::size_t i = n / (phis * inner) / inner, k = n % (phis * inner) / inner;
    shares[i * phis + k] += pdf[n].x * std::cos(points[n].theta_i) * cell;
  }
  return shares;
}

std::vector<Sample> draw(const Case& c, int count) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<SampleQuery> queries(static_cast<std::size_t>(count), SampleQuery{c.theta_o, c.phi_o, c.h, {}});
  for (SampleQuery& query : queries)
    for (double& u : query.u) u = unit(generator);
  std::vector<Sample> drawn(queries.size());
  EXPECT_TRUE(sample(model(), *parse_settings(model(), "", c.settings), Precision::f64, queries, drawn).ok());
  return drawn;
}

/// Chi-square of counts against shares over bins that expect at least 5, and their number.
std::pair<double, int> chi_square(const std::vector<double>& shares, const std::vector<Sample>& drawn) {
  std::vector<double> counts(shares.size());
  for (const Sample& s : drawn) {
    const int i = std::min(int((s.theta_i / pi + 0.5) * thetas), thetas - 1);
    const int k = std::min(int((std::remainder(s.phi, 2 * pi) / (2 * pi) + 0.5) * phis), phis - 1);
    counts[std::size_t(i * phis + k)] += 1;
  }
  double sum = 0;
  int bins = 0;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const double expected = shares[n] * double(drawn.size());
    if (expected < 5) continue;
    sum += (counts[n] - expected) * (counts[n] - expected) / expected;
    ++bins;
  }
  return {sum, bins};
}

TEST_P(HuangSampling, Density_IntegratesToOne) {
  for (int lobe : {-1, 1}) {
    double sum = 0;
    for (double share : expected_shares(GetParam(), lobe)) sum += share;
    EXPECT_NEAR(sum, 1, 2e-3) << lobe;
  }
}

TEST_P(HuangSampling, Samples_FollowTheirDensity) {
  const auto [value, bins] = chi_square(expected_shares(GetParam(), -1), draw(GetParam(), 6000));
  EXPECT_GT(bins, 40);
  EXPECT_LT(value, bins + 4.5 * std::sqrt(2.0 * bins));
}

TEST_P(HuangSampling, Weights_HaveTheAlbedoAsTheirMeanAndFewOutliers) {
  const std::vector<Sample> drawn = draw(GetParam(), 6000);
  const Point point{.theta_o = GetParam().theta_o, .h = GetParam().h, .phi_o = GetParam().phi_o};
  glm::dvec3 albedo;
  ASSERT_TRUE(evaluate(model(), *parse_settings(model(), "", GetParam().settings), Precision::f64,
                       {Quantity::albedo, -1, {&point, 1}}, {&albedo, 1})
                  .ok());
  double sum = 0, squares = 0;
  for (const Sample& s : drawn) {
    sum += s.weight.x / double(drawn.size());
    squares += s.weight.x * s.weight.x / double(drawn.size());
  }
  const double deviation = std::sqrt(squares - sum * sum);
  EXPECT_NEAR(sum, albedo.x, 0.2 * albedo.x);
  EXPECT_LT(deviation, 3 * sum);
}

}  // namespace
}  // namespace cuticle::bsdf::huang_sampling_test
