// The microfacet model against light walked through a rough fibre facet by facet.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "study/oracle/rough_fibre.h"

namespace cuticle::huang_oracle_test {
namespace {

using std::numbers::pi;

struct Case {
  double roughness, tilt, aspect, theta_o, phi_o;
  std::optional<double> h;
};
class HuangOracle : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Fibres, HuangOracle,
                         testing::Values(Case{0.4, 0.1, 1, 0.5, 0, {}}, Case{0.35, -0.1, 0.6, -0.4, 0.8, {}},
                                         Case{0.35, 0.1, 0.7, 0.3, 2.0, 0.5}));

study::oracle::RoughFibre fibre_of(const Case& c) {
  study::oracle::RoughFibre fibre;
  fibre.surface.roughness = c.roughness;
  fibre.tilt = c.tilt;
  fibre.aspect = c.aspect;
  fibre.sigma_a = glm::dvec3(0.1, 0.3, 1);
  return fibre;
}

/// Settings of one facet a meeting: TRT takes many paths.
std::string single(int lobe) { return fmt::format("facets=single,samples={}", lobe == 2 ? 4096 : 256); }

const bsdf::Model& model() { return **bsdf::find_model("huang"); }
registry::ParameterValues values_of(const Case& c, const std::string& facets) {
  const std::string settings = fmt::format("{},sigma_a=0.1/0.3/1,roughness={},tilt={},aspect={},field={}", facets,
                                           c.roughness, c.tilt, c.aspect, c.h ? "near" : "far");
  return *bsdf::parse_settings(model(), "", settings);
}
std::vector<glm::dvec3> model_values(const Case& c, const std::string& facets, bsdf::Quantity quantity, int lobe,
                                     const std::vector<bsdf::Point>& points) {
  std::vector<glm::dvec3> out(points.size());
  EXPECT_TRUE(bsdf::evaluate(model(), values_of(c, facets), bsdf::Precision::f64, {quantity, lobe, points}, out).ok());
  return out;
}

constexpr study::oracle::DirectionBins bins{8, 12};
constexpr int inner = 2;  // points along each side of a bin

std::vector<bsdf::Point> points_of_bins(const Case& c) {
  std::vector<bsdf::Point> points;
  for (int i = 0; i < bins.thetas * inner; ++i)
    for (int k = 0; k < bins.phis * inner; ++k)
      points.push_back({.theta_i = ((i + 0.5) / (bins.thetas * inner) - 0.5) * pi,
                        .theta_o = c.theta_o,
                        .phi = ((k + 0.5) / (bins.phis * inner) - 0.5) * 2 * pi,
                        .h = c.h.value_or(0),
                        .phi_o = c.phi_o});
  return points;
}
std::vector<glm::dvec3> means_over_bins(const std::vector<bsdf::Point>& points, const std::vector<glm::dvec3>& values) {
  std::vector<glm::dvec3> means(std::size_t(bins.thetas * bins.phis));
  std::vector<double> weights(means.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const std::size_t row = n / (bins.phis * inner) / inner, column = n % (bins.phis * inner) / inner;
    means[row * bins.phis + column] += values[n] * std::cos(points[n].theta_i);
    weights[row * bins.phis + column] += std::cos(points[n].theta_i);
  }
  for (std::size_t n = 0; n < means.size(); ++n) means[n] /= weights[n];
  return means;
}
/// Means of S over the bins.
std::vector<glm::dvec3> binned(const Case& c, const std::string& facets, int lobe) {
  const std::vector<bsdf::Point> points = points_of_bins(c);
  return means_over_bins(points, model_values(c, facets, bsdf::Quantity::S, lobe, points));
}
/// The same by all lights of the viewer together.
std::vector<glm::dvec3> binned_together(const Case& c, const std::string& facets) {
  const std::vector<bsdf::Point> points = points_of_bins(c);
  std::vector<glm::dvec3> values(points.size());
  EXPECT_TRUE(*bsdf::scattering_from_viewers(model(), values_of(c, facets), 1, -1, points, values));
  return means_over_bins(points, values);
}

TEST_P(HuangOracle, BinAverages_AgreeWithTheWalks) {
  const Case c = GetParam();
  const auto walks = study::oracle::scattering_of(fibre_of(c), {c.theta_o, c.phi_o, c.h}, bins, 3, 200000, 5);
  for (int lobe = 0; lobe < 3; ++lobe) {
    const auto means = binned(c, single(lobe), lobe);
    double largest = 0;
    for (const auto& mean : means) largest = std::max(largest, mean.x);
    for (std::size_t n = 0; n < means.size(); ++n) {
      const study::oracle::Estimate& truth = walks[std::size_t(lobe)].density[n];
      for (int colour = 0; colour < 3; ++colour)
        EXPECT_NEAR(means[n][colour], truth.mean[colour],
                    4.5 * truth.standard_error[colour] + 0.06 * truth.mean[colour] + 0.01 * largest)
            << "lobe " << lobe << " bin " << n;
    }
  }
}

TEST_P(HuangOracle, Albedo_IsTheEnergyOfTheWalks) {
  const Case c = GetParam();
  const auto walks = study::oracle::scattering_of(fibre_of(c), {c.theta_o, c.phi_o, c.h}, {1, 1}, 3, 200000, 6);
  for (int lobe = 0; lobe < 3; ++lobe) {
    const auto albedo = model_values(c, single(lobe), bsdf::Quantity::albedo, lobe,
                                     {{.theta_o = c.theta_o, .h = c.h.value_or(0), .phi_o = c.phi_o}})[0];
    const study::oracle::Estimate energy = walks[std::size_t(lobe)].energy;
    for (int colour = 0; colour < 3; ++colour)
      EXPECT_NEAR(albedo[colour], energy.mean[colour],
                  4 * energy.standard_error[colour] + (lobe == 2 ? 0.04 : 0.01) * energy.mean[colour])
          << lobe;
  }
}

/// Walks that follow light over any number of facets and crossings: sums over all orders, and the energies of R, TT,
/// TRT and all that is longer.
struct FollowedWalks {
  std::vector<glm::dvec3> density, variance;
  std::array<glm::dvec3, 4> energy{}, energy_variance{};
};
FollowedWalks followed_walks(const Case& c) {
  study::oracle::RoughFibre fibre = fibre_of(c);
  fibre.blocked = study::oracle::Blocked::followed;
  const auto orders = study::oracle::scattering_of(fibre, {c.theta_o, c.phi_o, c.h}, bins, 40, 200000, 7);
  FollowedWalks walks{std::vector<glm::dvec3>(orders[0].density.size()),
                      std::vector<glm::dvec3>(orders[0].density.size())};
  for (std::size_t order = 0; order < orders.size(); ++order) {
    const std::size_t lobe = std::min<std::size_t>(order, 3);
    walks.energy[lobe] += orders[order].energy.mean;
    walks.energy_variance[lobe] += orders[order].energy.standard_error * orders[order].energy.standard_error;
    for (std::size_t n = 0; n < walks.density.size(); ++n) {
      const study::oracle::Estimate& bin = orders[order].density[n];
      walks.density[n] += bin.mean;
      walks.variance[n] += bin.standard_error * bin.standard_error;
    }
  }
  return walks;
}

TEST_P(HuangOracle, FollowedLight_HasTheEnergyOfTheWalks) {
  const Case c = GetParam();
  const FollowedWalks walks = followed_walks(c);
  for (int lobe = 0; lobe < 4; ++lobe) {
    const auto albedo = model_values(c, "facets=multiple", bsdf::Quantity::albedo, lobe,
                                     {{.theta_o = c.theta_o, .h = c.h.value_or(0), .phi_o = c.phi_o}})[0];
    const std::size_t k = std::size_t(lobe);
    for (int colour = 0; colour < 3; ++colour)
      EXPECT_NEAR(albedo[colour], walks.energy[k][colour],
                  4 * std::sqrt(walks.energy_variance[k][colour]) + 0.01 * walks.energy[k][colour] + 5e-4)
          << lobe << " " << colour;
  }
}

void expect_where_the_walks_go(const std::vector<glm::dvec3>& means, const FollowedWalks& walks) {
  double largest = 0;
  for (const auto& mean : means) largest = std::max(largest, mean.x);
  for (std::size_t n = 0; n < means.size(); ++n)
    for (int colour = 0; colour < 3; ++colour)
      EXPECT_NEAR(means[n][colour], walks.density[n][colour],
                  4.5 * std::sqrt(walks.variance[n][colour]) + 0.06 * walks.density[n][colour] + 0.01 * largest)
          << "bin " << n << " colour " << colour;
}

TEST_P(HuangOracle, FollowedLight_GoesWhereTheWalksGo) {
  const FollowedWalks walks = followed_walks(GetParam());
  expect_where_the_walks_go(binned(GetParam(), "samples=1024", -1), walks);
  expect_where_the_walks_go(binned_together(GetParam(), "samples=8192"), walks);
}

}  // namespace
}  // namespace cuticle::huang_oracle_test
