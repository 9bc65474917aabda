// The sampler of the d'Eon model: its density is the reported one, its weights average to the albedo.
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/direction_grid.h"

namespace cuticle::bsdf::deon_sampling_test {
namespace {

constexpr double pi = std::numbers::pi;

const Model& model() { return **find_model("deon"); }

struct Case {
  const char* settings;
  double theta_o;
};
class DeonSampler : public testing::TestWithParam<Case> {
 protected:
  tests::View view() const {
    return {model(), std::string("azimuthal_tolerance=1e-4,") + GetParam().settings, GetParam().theta_o};
  }
};
INSTANTIATE_TEST_SUITE_P(Widths, DeonSampler,
                         testing::Values(Case{"beta_m=0.4,beta_n=0.5,alpha=-0.1", 0.6},
                                         Case{"beta_m=0.15,beta_n=0.15,alpha=0.1,sigma_a=2", -1.2},
                                         Case{"beta_m=0.4,beta_n=0.3,alpha=-0.17,r_lobe=non_separable", 1.3},
                                         Case{"beta_m=0.3,beta_n=1,sigma_a=0,attenuation_angle=theta_d", 0.2}));

TEST_P(DeonSampler, Samples_FollowTheirDensity) {
  EXPECT_LT(std::abs(tests::sampler_deviations(view(), {20, 20}, 3, 5000)), 4);
}

TEST_P(DeonSampler, DensityOfEachLobe_IntegratesToOne) {
  for (int lobe = -1; lobe < 4; ++lobe) {
    double sum = 0;
    for (double p : tests::probabilities(view(), lobe, {24, 8}, 3)) sum += p;
    EXPECT_NEAR(sum, 1, 3e-3) << lobe;
  }
}

TEST_P(DeonSampler, WeightsOnTheAverage_AreTheAlbedo) {
  EXPECT_LT(tests::weight_deviations(view(), 1000, Precision::f32), 4);
}

/// Standard deviation of azimuths about their circular mean.
double spread_of(const std::vector<double>& azimuths) {
  double x = 0, y = 0, squares = 0;
  for (double phi : azimuths) x += std::cos(phi), y += std::sin(phi);
  for (double phi : azimuths) squares += std::pow(std::remainder(phi - std::atan2(y, x), 2 * pi), 2);
  return std::sqrt(squares / double(azimuths.size()));
}

// u[0] is the offset, so the azimuths of a path at one offset have the detector's own width: beta_n, half and twice.
TEST(DeonSampler, AtOneOffset_AzimuthsHaveTheWidthOfTheirLobe) {
  std::array<std::vector<double>, 3> azimuths;
  const auto values = *parse_settings(model(), "", "beta_n=0.2,sigma_a=0,azimuthal_tolerance=0.1");
  std::mt19937_64 random(14);
  std::vector<SampleQuery> queries(4000, {.theta_o = 0.4});
  for (SampleQuery& query : queries) {
    for (double& u : query.u) u = double(random() >> 11) * 0x1p-53;
    query.u[0] = 0.97;
  }
  std::vector<Sample> samples(queries.size());
  ASSERT_TRUE(sample(model(), values, Precision::f64, queries, samples).ok());
  for (const Sample& s : samples)
    if (s.lobe < 3) azimuths[std::size_t(s.lobe)].push_back(s.phi);
  for (std::size_t p = 0; p < 3; ++p) {
    const double truth = std::array{0.2, 0.1, 0.4}[p];
    EXPECT_NEAR(spread_of(azimuths[p]), truth, 3.5 * truth / std::sqrt(2.0 * double(azimuths[p].size()))) << p;
  }
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
}  // namespace cuticle::bsdf::deon_sampling_test
