// The sampler of the d'Eon model: its density is the reported one, its weights average to the albedo.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <cuticle/bsdf/model.h>
#include <cuticle/core/quadrature.h>

namespace cuticle::bsdf {
namespace {

constexpr double pi = std::numbers::pi;

const Model& model() { return **find_model("deon"); }

std::vector<Sample> draw(const std::string& settings, double theta_o, int count, Precision precision = Precision::f64) {
  std::mt19937_64 random(2011);
  std::vector<SampleQuery> queries(std::size_t(count), SampleQuery{.theta_o = theta_o});
  for (SampleQuery& query : queries)
    for (double& u : query.u) u = double(random() >> 11) * 0x1p-53;
  std::vector<Sample> out(queries.size());
  EXPECT_TRUE(sample(model(), *parse_settings(model(), "", settings), precision, queries, out).ok());
  return out;
}

std::vector<double> values_at(const std::string& settings, Quantity quantity, int lobe,
                              const std::vector<Point>& points) {
  std::vector<glm::dvec3> out(points.size());
  EXPECT_TRUE(
      evaluate(model(), *parse_settings(model(), "", settings), Precision::f64, {quantity, lobe, points}, out).ok());
  std::vector<double> values;
  for (const glm::dvec3& value : out) values.push_back(value.x);
  return values;
}

/// Probabilities of the bins of a grid over theta_i and phi, by products of Gauss rules inside each.
struct Grid {
  int across, around;
  int bin(double theta_i, double phi) const {
    const int row = std::min(across - 1, int((theta_i / pi + 0.5) * across));
    return row * around + std::min(around - 1, int((phi / (2 * pi) + 0.5) * around));
  }
};
std::vector<double> probabilities(const std::string& settings, int lobe, double theta_o, const Grid& grid, int order) {
  const QuadratureRule rule = gauss_legendre(order);
  std::vector<Point> points;
  std::vector<double> weights;
  std::vector<int> bins;
  const double height = pi / grid.across / 2, width = pi / grid.around;
  for (int bin = 0; bin < grid.across * grid.around; ++bin)
    for (int i = 0; i < order; ++i)
      for (int k = 0; k < order; ++k) {
        const double theta_i = (2 * (bin / grid.around) + 1 + rule.nodes[std::size_t(i)]) * height - pi / 2;
        points.push_back({.theta_i = theta_i,
                          .theta_o = theta_o,
                          .phi = (2 * (bin % grid.around) + 1 + rule.nodes[std::size_t(k)]) * width - pi});
        weights.push_back(rule.weights[std::size_t(i)] * rule.weights[std::size_t(k)] * height * width *
                          std::cos(theta_i));
        bins.push_back(bin);
      }
  const std::vector<double> densities = values_at(settings, Quantity::pdf, lobe, points);
  std::vector<double> result(std::size_t(grid.across * grid.around));
  for (std::size_t i = 0; i < points.size(); ++i) result[std::size_t(bins[i])] += weights[i] * densities[i];
  return result;
}

/// Pearson's statistic in deviations from its mean; bins that expect fewer than 10 are pooled.
double chi_square_deviations(const std::vector<double>& counts, const std::vector<double>& expected) {
  double statistic = 0, pooled_count = 0, pooled_expected = 0;
  int used = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] < 10) {
      pooled_count += counts[i];
      pooled_expected += expected[i];
      continue;
    }
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    ++used;
  }
  if (pooled_expected > 10)
    statistic += (pooled_count - pooled_expected) * (pooled_count - pooled_expected) / pooled_expected;
  return (statistic - used) / std::sqrt(2.0 * used);
}

struct Case {
  const char* settings;
  double theta_o;
};
class DeonSampler : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Widths, DeonSampler,
    testing::Values(Case{"beta_m=0.4,beta_n=0.5,alpha=-0.1,azimuthal_tolerance=1e-4", 0.6},
                    Case{"beta_m=0.15,beta_n=0.15,alpha=0.1,sigma_a=2,azimuthal_tolerance=1e-4", -1.2},
                    Case{"beta_m=0.4,beta_n=0.3,alpha=-0.17,r_lobe=non_separable,azimuthal_tolerance=1e-4", 1.3},
                    Case{"beta_m=0.3,beta_n=1,sigma_a=0,attenuation_angle=theta_d,azimuthal_tolerance=1e-4", 0.2}));

TEST_P(DeonSampler, Samples_FollowTheirDensity) {
  const Grid grid{24, 24};
  const int count = 8000;
  std::vector<double> expected = probabilities(GetParam().settings, -1, GetParam().theta_o, grid, 4);
  for (double& e : expected) e *= count;
  std::vector<double> counts(expected.size());
  for (const Sample& s : draw(GetParam().settings, GetParam().theta_o, count))
    ++counts[std::size_t(grid.bin(s.theta_i, s.phi))];
  const double deviations = chi_square_deviations(counts, expected);
  EXPECT_LT(std::abs(deviations), 4);
}

TEST_P(DeonSampler, DensityOfEachLobe_IntegratesToOne) {
  for (int lobe = -1; lobe < 4; ++lobe) {
    double sum = 0;
    for (double p : probabilities(GetParam().settings, lobe, GetParam().theta_o, {24, 10}, 4)) sum += p;
    EXPECT_NEAR(sum, 1, 3e-3) << lobe;
  }
}

TEST_P(DeonSampler, WeightsOnTheAverage_AreTheAlbedo) {
  double sum = 0, squares = 0;
  const int count = 2000;
  for (const Sample& s : draw(GetParam().settings, GetParam().theta_o, count, Precision::f32)) {
    sum += s.weight.x;
    squares += s.weight.x * s.weight.x;
  }
  const double mean = sum / count, deviation = std::sqrt((squares / count - mean * mean) / count);
  const double albedo = values_at(GetParam().settings, Quantity::albedo, -1, {{.theta_o = GetParam().theta_o}})[0];
  EXPECT_NEAR(mean, albedo, 4 * deviation + 1e-4);
}

TEST(DeonSampler, AtTheEdgesOfItsNumbers_IsFinite) {
  const double last = 1 - 0x1p-53;
  for (const char* settings : {"beta_m=0.001,beta_n=0.001,sigma_a=100", "beta_m=1,beta_n=1,r_lobe=non_separable"})
    for (Precision precision : {Precision::f32, Precision::f64})
      for (double theta_o : {-pi / 2, 0.0, pi / 2})
        for (int corner = 0; corner < 64; ++corner) {
          SampleQuery query{.theta_o = theta_o};
          for (std::size_t i = 0; i < 6; ++i) query.u[i] = (corner >> i) & 1 ? last : 0;
          Sample s;
          ASSERT_TRUE(sample(model(), *parse_settings(model(), "", settings), precision, {&query, 1}, {&s, 1}).ok());
          EXPECT_TRUE(std::isfinite(s.theta_i) && std::isfinite(s.phi) && std::isfinite(s.pdf) &&
                      std::isfinite(s.weight.x));
        }
}

}  // namespace
}  // namespace cuticle::bsdf
