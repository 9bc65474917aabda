// The sampler and its density: the density integrates to 1 and is that of the draws, the weights average to the albedo.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "core/quadrature.h"

namespace cuticle::bsdf::marschner_sampling_test {
namespace {

constexpr double pi = std::numbers::pi;
const Model& model() { return **find_model("marschner"); }

struct Setting {
  const char* settings;
  double theta_o;
  int lobe;
  double phi_o = 0;
};

/// The density at many azimuths of one theta_i.
std::vector<double> densities(const Setting& s, double theta_i, const std::vector<double>& phis) {
  std::vector<Point> points;
  for (double phi : phis) points.push_back({.theta_i = theta_i, .theta_o = s.theta_o, .phi = phi});
  std::vector<glm::dvec3> out(points.size());
  const auto values = *parse_settings(model(), "", s.settings);
  model().evaluate_f64(values, {Quantity::pdf, s.lobe, points}, out);
  std::vector<double> result;
  for (const glm::dvec3& value : out) result.push_back(value.x);
  return result;
}

/// Azimuths in (0, pi) at which the density of exits has a singularity or a kink: the caustic of TRT, and the edge h
/// = 1.
std::vector<double> breaks(const Setting& s, double theta_i) {
  const double eta = parse_settings(model(), "", s.settings)->real("eta"), theta_d = (s.theta_o - theta_i) / 2;
  const double index = std::sqrt(eta * eta - std::pow(std::sin(theta_d), 2)) / std::cos(theta_d);
  std::vector<double> found = {0, pi, std::abs(4 * std::asin(1 / index) - pi),
                               pi - std::abs(2 * std::asin(1 / index) - pi)};
  const double h = std::sqrt(std::max(0.0, 4 - index * index) / 3);
  found.push_back(std::abs(4 * std::asin(h / index) - 2 * std::asin(h)));
  std::sort(found.begin(), found.end());
  return found;
}

/// The integral of the density over phi in [low, high] within [0, pi], at one theta_i: between breaks, with nodes that
/// thicken at both ends.
double azimuthal_mass(const Setting& s, double theta_i, double low, double high) {
  static const QuadratureRule rule = gauss_legendre(24);
  std::vector<double> phis, weights;
  const std::vector<double> ends = breaks(s, theta_i);
  for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
    const double begin = std::max(low, ends[e]), end = std::min(high, ends[e + 1]);
    if (end <= begin) continue;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double y = 0.5 * (1 + rule.nodes[k]), x = y * y * (3 - 2 * y);
      phis.push_back(begin + (end - begin) * x);
      weights.push_back(0.5 * rule.weights[k] * 6 * y * (1 - y) * (end - begin));
    }
  }
  const std::vector<double> values = densities(s, theta_i, phis);
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k) sum += values[k] * weights[k];
  return sum;
}

constexpr int bands = 24, sectors = 6;  // bins of sin theta_i in [-1, 1] and of |phi| in [0, pi]
double mass_of_bin(const Setting& s, int band, int sector) {
  static const QuadratureRule rule = gauss_legendre(12);
  const auto inner = [&](double sine) {
    return azimuthal_mass(s, std::asin(sine), sector * pi / sectors, (sector + 1) * pi / sectors);
  };
  return 2 * integrate(rule, 2.0 * band / bands - 1, 2.0 * (band + 1) / bands - 1, inner);
}

std::vector<double> masses(const Setting& s) {
  std::vector<double> result;
  for (int band = 0; band < bands; ++band)
    for (int sector = 0; sector < sectors; ++sector) result.push_back(mass_of_bin(s, band, sector));
  return result;
}

std::vector<Sample> draw(const Setting& s, int count, Precision precision) {
  std::mt19937 random(20161121);
  std::vector<SampleQuery> queries(static_cast<std::size_t>(count));
  for (SampleQuery& query : queries) {
    query.theta_o = s.theta_o;
    query.phi_o = s.phi_o;
    for (double& u : query.u) u = double(random()) / 4294967296.0;
  }
  std::vector<Sample> out(queries.size());
  EXPECT_TRUE(sample(model(), *parse_settings(model(), "", s.settings), precision, queries, out).ok());
  return out;
}

/// Pearson's statistic in standard deviations above its mean, bins of fewer than 10 expected draws put together.
double chi_square(const std::vector<double>& expected_share, const std::vector<double>& counted, double total) {
  double statistic = 0, rare = 0, rare_counted = 0;
  int bins = 0;
  for (std::size_t k = 0; k < expected_share.size(); ++k) {
    const double expected = expected_share[k] * total;
    if (expected < 10) {
      rare += expected;
      rare_counted += counted[k];
      continue;
    }
    statistic += (counted[k] - expected) * (counted[k] - expected) / expected;
    ++bins;
  }
  if (rare > 10) statistic += (rare_counted - rare) * (rare_counted - rare) / rare;
  return (statistic - bins) / std::sqrt(2.0 * bins);
}

class MarschnerSampler : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(Settings, MarschnerSampler,
                         testing::Values(Setting{"alpha=-0.15", 0.6, -1}, Setting{"alpha=0.1,beta=0.6", 1.4, -1},
                                         Setting{"beta=0.12,sigma_a=3", -0.4, -1}, Setting{"beta=0.4", 0.3, 0},
                                         Setting{"beta=0.4", 0.3, 1}, Setting{"beta=0.4", 0.3, 2},
                                         Setting{"eta=1.3,caustic=smoothed", 0.2, -1}, Setting{"aspect=0.85", 0.5, 2},
                                         Setting{"variant=as_published", 0.5, -1}));

TEST_P(MarschnerSampler, Density_IsThatOfTheDrawsAndIntegratesToOne) {
  const std::vector<double> expected = masses(GetParam());
  double sum = 0;
  for (double mass : expected) sum += mass;
  EXPECT_NEAR(sum, 1, 2e-4);
  std::vector<double> counted(expected.size());
  double total = 0;
  for (const Sample& drawn : draw(GetParam(), 200000, Precision::f64)) {
    if (GetParam().lobe >= 0 && drawn.lobe != GetParam().lobe) continue;
    const int band = std::min(bands - 1, int((std::sin(drawn.theta_i) + 1) / 2 * bands));
    const int sector = std::min(sectors - 1, int(std::abs(drawn.phi) / pi * sectors));
    counted[std::size_t(band * sectors + sector)] += 1;
    total += 1;
  }
  EXPECT_LT(chi_square(expected, counted, total), 5);
}

/// Mean and standard deviation of the weights.
struct Weights {
  double mean = 0, deviation = 0;
};
Weights weights_of(const Setting& s, Precision precision) {
  double sum = 0, squares = 0;
  const std::vector<Sample> drawn = draw(s, 100000, precision);
  for (const Sample& one : drawn) {
    sum += one.weight.x;
    squares += one.weight.x * one.weight.x;
  }
  const double mean = sum / double(drawn.size());
  return {mean, std::sqrt(squares / double(drawn.size()) - mean * mean)};
}
double albedo_of(const Setting& s) {
  const Point point{.theta_o = s.theta_o, .phi_o = s.phi_o};
  std::vector<glm::dvec3> out(1);
  model().evaluate_f64(*parse_settings(model(), "", s.settings), {Quantity::albedo, -1, {&point, 1}}, out);
  return out[0].x;
}

struct Estimate {
  const char* settings;
  double theta_o, most_deviation;  ///< of a weight, relative to the mean
  double phi_o = 0;
};
class MarschnerWeights : public testing::TestWithParam<Estimate> {};
INSTANTIATE_TEST_SUITE_P(
    Settings, MarschnerWeights,
    testing::Values(Estimate{"", 0.3, 0.6}, Estimate{"beta=0.02", -0.7, 0.85}, Estimate{"sigma_a=5,eta=1.4", 1.2, 1.2},
                    Estimate{"beta=1,alpha=0.17", 0.2, 0.35}, Estimate{"caustic=smoothed", 0.3, 0.65},
                    Estimate{"aspect=0.85", 0.3, 0.95, pi / 2}, Estimate{"caustic=smoothed,aspect=0.9", 0.3, 0.65},
                    Estimate{"attenuation_angle=theta_o", -0.7, 0.6}, Estimate{"variant=as_published", 0.3, 1.8}));
TEST_P(MarschnerWeights, Mean_IsTheAlbedo) {
  const Setting s{GetParam().settings, GetParam().theta_o, -1, GetParam().phi_o};
  for (Precision precision : {Precision::f64, Precision::f32}) {
    const Weights weights = weights_of(s, precision);
    const double albedo = albedo_of(s);
    EXPECT_NEAR(weights.mean, albedo, 4 * weights.deviation / std::sqrt(100000.0) + 1e-3 * albedo);
    EXPECT_LT(weights.deviation, GetParam().most_deviation * albedo);
    testing::Test::RecordProperty("relative_deviation", std::to_string(weights.deviation / albedo));
  }
}

TEST(MarschnerSampler, AtTheEdgesOfTheDomain_DrawsAreFinite) {
  for (const char* settings : {"beta=0.001,sigma_a=0", "beta=1,sigma_a=100,eta=1.05", "eta=3,variant=as_published",
                               "caustic=smoothed,aspect=0.5,eta=2", "aspect=2,alpha=0.17"})
    for (double theta_o : {-pi / 2, 0.0, pi / 2})
      for (Precision precision : {Precision::f64, Precision::f32})
        for (const Sample& drawn : draw({settings, theta_o, -1}, 2000, precision)) {
          ASSERT_TRUE(std::isfinite(drawn.theta_i) && std::isfinite(drawn.phi) && std::abs(drawn.phi) < 3.1416);
          ASSERT_TRUE(drawn.pdf >= 0 && std::isfinite(drawn.pdf) && std::isfinite(drawn.weight.x)) << settings;
        }
}

}  // namespace
}  // namespace cuticle::bsdf::marschner_sampling_test
