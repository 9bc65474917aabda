// The fur model against walks through a fibre with a scattering medulla: how much light comes back, and where it goes.
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "core/random.h"
#include "study/oracle/rough_fibre.h"

namespace cuticle::bsdf::yan_fur_oracle_test {
namespace {

constexpr double pi = std::numbers::pi;

const Model& model() { return **find_model("yan_fur"); }

/// A smooth, untilted fibre seen from theta_o, with its medulla.
struct Fur {
  double kappa, sigma_ms, g, theta_o, sigma_a = 0, sigma_ma = 0;
  std::string settings() const {
    return fmt::format("sigma_a={},kappa={},sigma_ms={},sigma_ma={},g={},beta_m=0.02,beta_n=0.02,alpha=0,field=near",
                       sigma_a, kappa, sigma_ms, sigma_ma, g);
  }
  study::oracle::RoughFibre fibre() const {
    return {.sigma_a = glm::dvec3(sigma_a),
            .surface = {.roughness = 0},
            .medulla = {kappa, sigma_ms, glm::dvec3(sigma_ma), g}};
  }
};

/// Shares of energy over even bins of phi and of sin(theta_i), and in all.
struct Shares {
  std::vector<double> phi = std::vector<double>(24), sine = std::vector<double>(12);
  double energy = 0;
  void add(double theta_i, double azimuth, double weight) {
    phi[std::min<std::size_t>(23, std::size_t((azimuth / (2 * pi) + 0.5) * 24))] += weight;
    sine[std::min<std::size_t>(11, std::size_t((std::sin(theta_i) + 1) * 6))] += weight;
    energy += weight;
  }
};

Shares walked(const Fur& fur, int count) {
  Shares shares;
  const study::oracle::RoughFibre fibre = fur.fibre();
  for (int n = 0; n < count; ++n) {
    RandomStream random(7, std::uint64_t(n));
    const study::oracle::Departure end = walk(fibre, {.theta_o = fur.theta_o, .h = std::nullopt}, 200, random);
    shares.add(end.theta_i, end.phi, end.energy.x / count);
  }
  return shares;
}

Shares sampled(const Fur& fur, int count) {
  std::vector<SampleQuery> queries(std::size_t(count), SampleQuery{.theta_o = fur.theta_o});
  for (std::size_t n = 0; n < queries.size(); ++n) {
    RandomStream random(8, n);
    queries[n].h = 2 * random.next_unit() - 1;
    for (double& u : queries[n].u) u = random.next_unit();
  }
  std::vector<Sample> out(queries.size());
  EXPECT_TRUE(sample(model(), *parse_settings(model(), "", fur.settings()), Precision::f64, queries, out).ok());
  Shares shares;
  for (const Sample& s : out) shares.add(s.theta_i, s.phi, s.weight.x / count);
  return shares;
}

/// The energy that would have to move to another bin, of all that there is.
double misplaced(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]) / 2;
  return sum;
}

/// A fibre and how far the model may be from it: energy misplaced in azimuth and in inclination, and energy in all.
struct Case {
  Fur fur;
  double azimuth, inclination, energy;
};
class YanFurOracle : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Medullas, YanFurOracle,
    testing::Values(Case{{0.8, 0.5, 0, 0.3}, 0.05, 0.03, 1e-6}, Case{{0.8, 2, 0.4, 0.3}, 0.065, 0.055, 1e-6},
                    Case{{0.8, 2, 0.8, 0.3}, 0.075, 0.035, 1e-6}, Case{{0.8, 10, 0, 0.3}, 0.06, 0.03, 1e-6},
                    Case{{0.5, 2, 0.6, 0.9}, 0.07, 0.1, 1e-6}, Case{{0.9, 20, 0.4, 0.9}, 0.065, 0.04, 1e-6},
                    Case{{0.7, 4, -0.4, 0}, 0.08, 0.12, 1e-6}, Case{{0.7, 2, 0.4, 0.3, 0.3, 0.3}, 0.02, 0.02, 0.006},
                    Case{{0.7, 8, 0.4, 0.3, 1, 0}, 0.02, 0.015, 0.006},
                    Case{{0.7, 8, 0.4, 0.3, 0, 1}, 0.03, 0.02, 0.022},
                    Case{{0.9, 3, 0.4, 0.3, 0.1, 0.1}, 0.035, 0.025, 0.006},
                    Case{{0.4, 5, 0, 0.9, 0.1, 0.1}, 0.03, 0.05, 0.006},
                    Case{{0.8, 20, 0.8, 0.3, 0.05, 0.05}, 0.05, 0.02, 0.006}));
TEST_P(YanFurOracle, Light_GoesWhereWalksGo) {
  const Case& c = GetParam();
  const Shares truth = walked(c.fur, 20000), result = sampled(c.fur, 20000);
  RecordProperty("misplaced_in_phi", std::to_string(misplaced(truth.phi, result.phi)));
  RecordProperty("misplaced_in_sine", std::to_string(misplaced(truth.sine, result.sine)));
  RecordProperty("energy_and_walks", std::to_string(result.energy) + ", " + std::to_string(truth.energy));
  EXPECT_LT(misplaced(truth.phi, result.phi), c.azimuth);
  EXPECT_LT(misplaced(truth.sine, result.sine), c.inclination);
  EXPECT_NEAR(result.energy, truth.energy, c.energy);
}

}  // namespace
}  // namespace cuticle::bsdf::yan_fur_oracle_test
