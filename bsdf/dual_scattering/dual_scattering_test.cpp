// Dual scattering terms: closed forms of an isotropic fibre, energy of the models, the paper's sums as series.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/dual_scattering/dual_scattering.h"
#include "bsdf/dual_scattering/kept_terms.h"

namespace cuticle::bsdf::dual_scattering_test {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;
const glm::dvec3 isotropic_albedo(0.2, 0.6, 1);

/// A fibre that scatters evenly over all directions.
const Model& isotropic() {
  static const Model model{.entry = {.name = "isotropic", .summary = "scatters evenly", .source = "this test"},
                           .lobes = {},
                           .conventions = {},
                           .evaluate_f32 = nullptr,
                           .evaluate_f64 =
                               [](const registry::ParameterValues&, const Request&, std::span<glm::dvec3> out) {
                                 for (glm::dvec3& value : out) value = isotropic_albedo / (4 * pi);
                               },
                           .pack = nullptr};
  return model;
}

TEST(DualScattering, IsotropicFibre_SendsHalfEachWay) {
  for (double theta : {-1.2, 0.0, 0.7}) {
    const AverageScattering average = *average_scattering(isotropic(), {}, theta);
    for (const HalfScattering& half : {average.forward, average.backward})
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(half.share[c], isotropic_albedo[c] / 2, 1e-14);
        EXPECT_NEAR(half.shift[c], theta, 1e-14);
        EXPECT_NEAR(half.deviation[c], std::sqrt(pi * pi / 4 - 2), 1e-12);
      }
  }
}

struct Case {
  const char* model;
  const char* settings;
  double theta;
  double tolerance = 1e-4;  ///< of the albedo; walks have noise
};
class DualScatteringEnergy : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Models, DualScatteringEnergy,
                         testing::Values(Case{"deon",
                                              "beta_m=0.2,beta_n=0.3,sigma_a=0.1/0.5/2,azimuthal_tolerance=1e-4", 0.6},
                                         Case{"yan_fur", "field=near,beta_m=0.3,beta_n=0.3,sigma_a=0.1/0.5/2", -0.4},
                                         Case{"marschner", "beta=0.1,sigma_a=0.1/0.5/2", 1.2},
                                         Case{"huang", "roughness=0.3,sigma_a=0.1/0.5/2", 0.3, 0.01}));
TEST(DualScattering, FlatFibre_IsTheMeanOverTurns) {
  const Model& model = **find_model("marschner");
  const auto average_of = [&](const char* settings) {
    const AverageScattering average = *average_scattering(model, *parse_settings(model, "", settings), 0.3);
    return average.backward.share.x;
  };
  EXPECT_EQ(average_of("caustic=smoothed,aspect=0.9"), average_of("caustic=smoothed,aspect=0.9,turns=2"));
}

/// Of all offsets together: a near field's mean over the width by 400 of them, evenly in their angles.
glm::dvec3 albedo_of_width(const Model& model, const registry::ParameterValues& values, double theta) {
  const int count = model.near_field && model.near_field(values) ? 400 : 1;
  std::vector<Point> points;
  for (int k = 0; k < count; ++k) points.push_back({.theta_o = theta, .h = std::sin(((k + 0.5) / count - 0.5) * pi)});
  std::vector<glm::dvec3> albedo(points.size());
  EXPECT_TRUE(evaluate(model, values, Precision::f64, {Quantity::albedo, -1, points}, albedo).ok());
  if (count == 1) return albedo.front();
  glm::dvec3 mean(0);
  for (int k = 0; k < count; ++k)
    mean += albedo[std::size_t(k)] * (std::cos(((k + 0.5) / count - 0.5) * pi) * pi / (2 * count));
  return mean;
}

TEST_P(DualScatteringEnergy, BothShares_AddUpToTheAlbedo) {
  const Model& model = **find_model(GetParam().model);
  const registry::ParameterValues values = *parse_settings(model, "", GetParam().settings);
  const AverageScattering average = *average_scattering(model, values, GetParam().theta);
  const glm::dvec3 albedo = albedo_of_width(model, values, GetParam().theta);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(average.forward.share[c] + average.backward.share[c], albedo[c], GetParam().tolerance) << c;
}

// A tilted R lobe peaks at theta_i + theta_o = 2 alpha, and nearly all that a black fibre sends back is R.
TEST(DualScattering, BlackFibre_SendsBackItsReflection) {
  const Model& deon = **find_model("deon");
  const auto values =
      *parse_settings(deon, "", "sigma_a=100,alpha=-0.05,beta_m=0.1,beta_n=0.3,azimuthal_tolerance=1e-3");
  const AverageScattering average = *average_scattering(deon, values, 0.2);
  EXPECT_NEAR(average.backward.shift.x, -0.1, 3e-3);
  EXPECT_NEAR(average.backward.deviation.x, 0.1, 3e-3);
}

// TT, which leaves away from the light, has most of what a clear fibre scatters.
TEST(DualScattering, ClearFibre_LetsMostLightThrough) {
  const Model& deon = **find_model("deon");
  const AverageScattering average =
      *average_scattering(deon, *parse_settings(deon, "", "sigma_a=0.05,azimuthal_tolerance=1e-3"), 0.2);
  EXPECT_GT(average.forward.share.x, 2 * average.backward.share.x);
}

AverageScattering shares_of(double forward, double backward) {
  AverageScattering average;
  average.forward.share = glm::dvec3(forward);
  average.backward.share = glm::dvec3(backward);
  return average;
}

// One backward scattering after n forward ones and n on the way back; three of them with every split of the forward
// ones.
TEST(DualScattering, Attenuation_IsTheSumOverAllPaths) {
  for (double forward : {0.1, 0.5, 0.7})
    for (double backward : {0.01, 0.3}) {
      double sum = 0;
      for (int n = 1; n < 400; ++n)
        sum += std::pow(forward, 2 * n) * (backward + std::pow(backward, 3) * n * (n + 1) / 2);
      EXPECT_NEAR(multiple_backscattering(shares_of(forward, backward))->attenuation.x, sum, 1e-13);
    }
}

TEST(DualScattering, WhiteFibre_SendsBackFiveEighthsAtMost) {
  EXPECT_NEAR(multiple_backscattering(shares_of(1 - 1e-9, 1e-9))->attenuation.x, 0.625, 1e-7);
  EXPECT_EQ(multiple_backscattering(shares_of(1, 0))->attenuation.x, 0);
}

TEST(DualScattering, SpreadOfOneRareBackscattering_IsThatOfThreeLobes) {
  AverageScattering average = shares_of(1e-4, 1e-6);
  average.forward.deviation = glm::dvec3(0.2);
  average.backward.deviation = glm::dvec3(0.1);
  average.backward.shift = glm::dvec3(0.3);
  average.forward.shift = glm::dvec3(-0.1);
  const MultipleBackscattering multiple = *multiple_backscattering(average);
  EXPECT_NEAR(multiple.deviation.x, std::sqrt(2 * 0.04 + 0.01), 1e-6);
  EXPECT_NEAR(multiple.shift.x, 0.3 - 2 * 0.1, 1e-6);
}

TEST(DualScattering, Table_HasItsRowsAtTheMiddlesOfEqualParts) {
  const auto table = *dual_scattering_terms(isotropic(), {}, 4);
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_NEAR(table.rows[0].theta, -3 * pi / 8, 1e-15);
  EXPECT_NEAR(table.rows[2].average.forward.share.z, 0.5, 1e-14);
}

TEST(DualScattering, TableBetweenRows_IsNearTheAverageThere) {
  const Model& deon = **find_model("deon");
  const auto values = *parse_settings(deon, "", "sigma_a=0.3,beta_m=0.3,beta_n=0.3,azimuthal_tolerance=1e-3");
  const DualScatteringTable table = *dual_scattering_terms(deon, values, 32);
  const DualScatteringRow row = table.at(0.33);
  const AverageScattering exact = *average_scattering(deon, values, 0.33);
  EXPECT_NEAR(row.average.forward.share.x / exact.forward.share.x, 1, 2e-3);
  EXPECT_NEAR(row.average.backward.deviation.x / exact.backward.deviation.x, 1, 2e-3);
  EXPECT_NEAR(row.average.forward.shift.x, exact.forward.shift.x, 2e-3);
  EXPECT_EQ(table.at(-2).average.forward.share.x, table.rows.front().average.forward.share.x);
  EXPECT_EQ(table.at(2).multiple.attenuation.x, table.rows.back().multiple.attenuation.x);
}

// The far field's averages, which take minutes, are those of the near field.
TEST(DualScattering, KeptTerms_AreOfTheNearField) {
  const Model& chiang = **find_model("chiang");
  const auto of_field = [&](const std::string& field) {
    return *parse_settings(chiang, "", "sigma_a=0.3,beta_m=0.5,beta_n=0.5,field=" + field);
  };
  const auto kept = *kept_dual_scattering_terms(chiang, of_field("far"));
  ASSERT_EQ(kept.rows.size(), std::size_t(k_dual_scattering_rows));
  const DualScatteringRow& row = kept.rows[18];
  const AverageScattering near = *average_scattering(chiang, of_field("near"), row.theta);
  EXPECT_EQ(row.average.forward.share, near.forward.share);
  EXPECT_EQ(row.average.backward.deviation, near.backward.deviation);
}

TEST(DualScattering, BadRequests_AreRefusedByName) {
  EXPECT_THAT(dual_scattering_terms(isotropic(), {}, 0).error().message, HasSubstr("count"));
  EXPECT_THAT(average_scattering(isotropic(), {}, 2).error().message, HasSubstr("theta_o"));
  EXPECT_THAT(multiple_backscattering(shares_of(1.1, 0.1)).error().message, HasSubstr("below 1"));
}

}  // namespace
}  // namespace cuticle::bsdf::dual_scattering_test
