// The fur model of Yan et al.: energy, limits, near against far field, the sampler, hard cases, bad parameters.
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/csv_table.h"
#include "tests/support/direction_grid.h"
#include "tests/support/hard_cases.h"

namespace cuticle::bsdf::yan_fur_test {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;

const Model& model() { return **find_model("yan_fur"); }

constexpr tests::ValuesOf evaluate_at{"yan_fur"};
constexpr tests::ValueOf value_at{"yan_fur"};

/// A row of shares.csv: settings, lobe, point and value of A.
TEST(YanFur, Shares_AgreeWithMpmath) {
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/bsdf/yan_fur/reference/shares.csv")) {
    const std::string settings = fmt::format("eta={},sigma_a={},kappa={},sigma_ms={},sigma_ma={},layers={}",
                                             row.text("eta"), row.text("sigma_a"), row.text("kappa"),
                                             row.text("sigma_ms"), row.text("sigma_ma"), row.text("layers"));
    const Point point{.theta_d = row.number("theta_d"), .h = row.number("h")};
    const int lobe = int(row.number("lobe"));
    const double truth = row.number("a");
    // What is left of scattered light is a double integral, by Gauss's rule.
    EXPECT_NEAR(value_at(settings, Quantity::A, lobe, point), truth, (lobe < 3 ? 2e-13 : 6e-5) * truth)
        << settings << " lobe " << lobe;
    EXPECT_NEAR(value_at(settings, Quantity::A, lobe, point, Precision::f32), truth, (lobe < 3 ? 2e-5 : 7e-5) * truth)
        << settings << " lobe " << lobe;
  }
}

TEST(YanFur, WhiteFibre_ScattersAll) {
  for (const char* settings : {"sigma_a=0,sigma_ma=0", "sigma_a=0,sigma_ma=0,kappa=0.95,sigma_ms=20,layers=3,eta=1.2"})
    for (double theta_o : {0.0, 0.6, 1.4, 1.5707}) {
      EXPECT_NEAR(value_at(settings, Quantity::albedo, -1, {.theta_o = theta_o}), 1, 1e-6)
          << settings << " " << theta_o;
      for (double h : {-1.0, -0.6, 0.0, 0.9})
        EXPECT_NEAR(value_at(std::string(settings) + ",field=near", Quantity::albedo, -1, {.theta_o = theta_o, .h = h}),
                    1, 1e-12);
    }
}

/// The integral of S cos(theta_i) over all directions by products of midpoints.
double furnace(const std::string& settings, int lobe, const Point& view) {
  const int across = 160, around = 160;
  std::vector<Point> points;
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < around; ++k)
      points.push_back({.theta_i = ((i + 0.5) / across - 0.5) * pi,
                        .theta_o = view.theta_o,
                        .phi = (2 * (k + 0.5) / around - 1) * pi,
                        .h = view.h});
  const auto values = evaluate_at(settings, Quantity::S, lobe, points);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += values[i].x * std::cos(points[i].theta_i) * 2 * pi * pi / (across * around);
  return sum;
}
TEST(YanFur, Albedo_IsTheIntegralOfSInBothFields) {
  const std::string settings = "beta_m=0.5,beta_n=0.3,sigma_ma=0.4,azimuthal_tolerance=1e-3";
  const Point view{.theta_o = 0.5, .h = 0.4};
  for (int lobe = 0; lobe < 6; ++lobe)
    EXPECT_NEAR(furnace(settings + ",field=near", lobe, view),
                value_at(settings + ",field=near", Quantity::albedo, lobe, view), 2e-4)
        << lobe;
  EXPECT_NEAR(furnace(settings, 3, view), value_at(settings, Quantity::albedo, 3, view), 2e-4);
}

TEST(YanFur, AlbedoAtThetaD_IsTheIntegralOfS) {
  const std::string settings =
      "beta_m=0.5,beta_n=0.3,g=0.8,sigma_ms=1,sigma_ma=0.4,attenuation_angle=theta_d,field=near";
  const Point view{.theta_o = 0.5, .h = 0.4};
  for (int lobe = 0; lobe < 6; ++lobe)
    EXPECT_NEAR(furnace(settings, lobe, view), value_at(settings, Quantity::albedo, lobe, view), 3e-4) << lobe;
}

TEST(YanFur, FarField_IsTheMeanOfTheNearField) {
  const int count = 2000;
  for (double phi : {0.3, 2.0, 3.1})
    for (int lobe = 0; lobe < 6; ++lobe) {
      std::vector<Point> points;
      for (int k = 0; k < count; ++k)
        points.push_back({.theta_i = 0.1, .theta_o = 0.5, .phi = phi, .h = std::sin(((k + 0.5) / count - 0.5) * pi)});
      const auto near = evaluate_at("field=near", Quantity::S, lobe, points);
      double mean = 0;
      for (int k = 0; k < count; ++k)
        mean += near[std::size_t(k)].x * std::cos(((k + 0.5) / count - 0.5) * pi) * pi / count / 2;
      const double far = value_at("", Quantity::S, lobe, points[0]);
      EXPECT_NEAR(far, mean, 2e-5 * std::max(mean, 1e-9)) << lobe << " " << phi;
      EXPECT_LE(value_at("", Quantity::error, lobe, points[0]), 1e-5 * far + 1e-12);
    }
}

// Without a medulla and with one layer the unscattered lobes are those of a plain rough fibre.
TEST(YanFur, WithoutMedulla_IsAFibreOfCortex) {
  const Point point{.theta_d = 0.3, .h = 0.5};
  for (int lobe = 3; lobe < 5; ++lobe) EXPECT_EQ(value_at("kappa=0", Quantity::A, lobe, point), 0);
  const Model& marschner = **find_model("marschner");
  for (int lobe = 0; lobe < 3; ++lobe) {
    glm::dvec3 plain;
    ASSERT_TRUE(evaluate(marschner, *parse_settings(marschner, "", "sigma_a=0.2,eta=1.55"), Precision::f64,
                         {Quantity::A, lobe, {&point, 1}}, {&plain, 1})
                    .ok());
    EXPECT_NEAR(value_at("kappa=0,sigma_ms=5", Quantity::A, lobe, point), plain.x, 1e-14);
  }
}

TEST(YanFur, AtThetaDWithoutTilt_IsReciprocal) {
  const std::string settings = "alpha=0,attenuation_angle=theta_d";
  for (double phi : {0.2, 1.7, 3.0})
    for (int lobe = 0; lobe < 6; ++lobe) {
      const double forth = value_at(settings, Quantity::S, lobe, {.theta_i = 0.5, .theta_o = -0.9, .phi = phi});
      const double back = value_at(settings, Quantity::S, lobe, {.theta_i = -0.9, .theta_o = 0.5, .phi = -phi});
      EXPECT_NEAR(forth, back, 1e-10 * forth) << lobe << " " << phi;
      EXPECT_GT(forth, 0) << lobe;
    }
}

struct Case {
  const char* settings;
  double theta_o, h;
};
class FurSampler : public testing::TestWithParam<Case> {
 protected:
  tests::View view() const {
    return {model(), std::string("azimuthal_tolerance=1e-3,") + GetParam().settings, GetParam().theta_o, GetParam().h};
  }
};
INSTANTIATE_TEST_SUITE_P(Fields, FurSampler,
                         testing::Values(Case{"field=near,beta_m=0.3,beta_n=0.3,g=0.8,sigma_ms=1,alpha=-0.1", 0.6,
                                              -0.4},
                                         Case{"field=near,beta_m=0.3,beta_n=0.3,g=-0.5,sigma_ms=8", -1, 0.2},
                                         Case{"beta_m=0.4,beta_n=0.4,g=0.5,sigma_ma=0.5", 0.3, 0}));
TEST_P(FurSampler, Samples_FollowTheirDensity) {
  EXPECT_LT(std::abs(tests::sampler_deviations(view(), {16, 16}, 4, 5000)), 4);
}
TEST_P(FurSampler, DensityOfEachLobe_IntegratesToOne) {
  for (int lobe = -1; lobe < 6; ++lobe) {
    double sum = 0;
    for (double p : tests::probabilities(view(), lobe, {16, 8}, 3)) sum += p;
    EXPECT_NEAR(sum, 1, 3e-3) << lobe;
  }
}
TEST_P(FurSampler, WeightsOnTheAverage_AreTheAlbedo) {
  EXPECT_LT(tests::weight_deviations(view(), 1000, Precision::f32), 4);
}

/// Settings and points that are hard, or drawn over the whole domain by a fixed seed.
std::string hard_settings(std::mt19937& random) {
  constexpr std::array<double, 4> etas = {1.05, 1.55, 2, 3}, sigmas = {0, 0.2, 5, 100}, betas = {1e-3, 0.02, 0.3, 1},
                                  kappas = {0, 0.3, 0.8, 0.99}, gs = {-0.9, 0, 0.4, 0.9}, layers = {0.1, 1, 3, 10};
  return fmt::format(
      "eta={},sigma_a={},sigma_ms={},sigma_ma={},kappa={},g={},layers={},beta_m={},beta_n={},azimuthal_tolerance=1e-2,"
      "field={}",
      tests::pick(random, etas), tests::pick(random, sigmas), tests::pick(random, sigmas), tests::pick(random, sigmas),
      tests::pick(random, kappas), tests::pick(random, gs), tests::pick(random, layers), tests::pick(random, betas),
      tests::pick(random, betas), random() % 3 ? "near" : "far");
}
class FurDomain : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(Precisions, FurDomain, testing::Values(Precision::f32, Precision::f64));
TEST_P(FurDomain, EveryValue_IsFiniteAndNotNegative) {
  std::mt19937 random(20170720);
  for (int set = 0; set < 40; ++set) {
    const std::string settings = hard_settings(random);
    const std::vector<Point> points = tests::hard_points(random, 12);
    for (Quantity quantity :
         {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::albedo, Quantity::pdf, Quantity::error})
      for (int lobe = -1; lobe < 6; ++lobe)
        tests::expect_finite_and_not_negative(evaluate_at, settings, quantity, lobe, points, GetParam());
  }
}

TEST(YanFur, Fibre_MapsItsMedulla) {
  const FibreMapping mapping =
      model().from_fibre({.medulla_ratio = 1, .medulla_scattering = 3, .medulla_anisotropy = -1});
  const auto values = parse_settings(model(), "", mapping.settings);
  ASSERT_TRUE(values.ok());
  EXPECT_EQ(values->real("kappa"), 0.99);
  EXPECT_EQ(values->real("sigma_ms"), 3);
  EXPECT_EQ(values->real("g"), -0.9);
}

struct Refusal {
  const char* settings;
  const char* words;
};
class FurParameters : public testing::TestWithParam<Refusal> {};
INSTANTIATE_TEST_SUITE_P(Bad, FurParameters,
                         testing::Values(Refusal{"kappa=1", "kappa"}, Refusal{"sigma_ms=-1", "sigma_ms"},
                                         Refusal{"g=0.95", "g"}, Refusal{"layers=0", "layers"},
                                         Refusal{"field=mid", "near"}));
TEST_P(FurParameters, OutOfRange_AreRefusedByName) {
  const auto values = parse_settings(model(), "", GetParam().settings);
  ASSERT_FALSE(values.ok());
  EXPECT_THAT(values.error().message, HasSubstr(GetParam().words));
}

}  // namespace
}  // namespace cuticle::bsdf::yan_fur_test
