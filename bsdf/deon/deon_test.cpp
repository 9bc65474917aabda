// The model of d'Eon et al.: tables by mpmath, energy, the variants, hard cases, bad parameters.
#define GLM_FORCE_XYZW_ONLY
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/deon/deon.glslh"
#include "bsdf/model.h"
#include "bsdf/shared/batch.h"
#include "tests/support/condition_number.h"
#include "tests/support/csv_table.h"
#include "tests/support/hard_cases.h"

namespace cuticle::bsdf::deon_test {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;
constexpr const char* fine = "azimuthal_tolerance=1e-12";

const Model& model() { return **find_model("deon"); }

constexpr tests::ValuesOf evaluate_at{"deon"};
constexpr tests::ValueOf value_at{"deon"};

/// A row of azimuthal.csv as settings, lobe and point.
struct AzimuthalCase {
  std::string settings;
  int lobe;
  Point point;
  double truth;
};
std::vector<AzimuthalCase> azimuthal_cases() {
  std::vector<AzimuthalCase> cases;
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/bsdf/deon/reference/azimuthal.csv"))
    cases.push_back(
        {fmt::format("eta={},sigma_a={},beta_n={}", row.text("eta"), row.text("sigma_a"), row.text("beta_n")),
         int(row.number("lobe")),
         {.theta_d = row.number("theta_d"), .phi = row.number("phi")},
         row.number("n")});
  return cases;
}

/// The largest error of N over the table, relative to the value or to 1e-4 of a unit.
double worst_azimuthal(const std::string& more, Precision precision) {
  double worst = 0;
  for (const AzimuthalCase& c : azimuthal_cases()) {
    const double value = value_at(c.settings + more, Quantity::N, c.lobe, c.point, precision);
    worst = std::max(worst, std::abs(value - c.truth) / std::max(c.truth, 1e-4));
  }
  testing::Test::RecordProperty("worst", fmt::format("{:.2g}", worst));
  return worst;
}

TEST(Deon, AzimuthalAtTheFinestTolerance_AgreesWithMpmath) {
  EXPECT_LE(worst_azimuthal(std::string(",") + fine, Precision::f64), 6e-15);
}
TEST(Deon, AzimuthalAtTheUsualTolerance_AgreesWithMpmath) { EXPECT_LE(worst_azimuthal("", Precision::f64), 1e-12); }
TEST(Deon, AzimuthalAtACoarseTolerance_AgreesWithMpmath) {
  EXPECT_LE(worst_azimuthal(",azimuthal_tolerance=1e-2", Precision::f64), 5e-5);
}
TEST(Deon, FloatAzimuthal_AgreesWithMpmath) { EXPECT_LE(worst_azimuthal("", Precision::f32), 1e-5); }

/// The M of the R lobe of 2014 with its condition number, at one place.
template <class Real>
Real non_separable_of(const deon::Deon<Real>& m, const EvaluationPoint<Real>& at) {
  return deon::longitudinal_of(m, 0, deon::make_inclinations(at.theta_i, at.theta_o), at.phi);
}
template <class Real>
deon::Deon<Real> prepared_of(const tests::CsvRow& row) {
  const std::string settings = fmt::format("r_lobe=non_separable,beta_m={}", row.text("beta_m"));
  const std::vector<float> numbers = model().pack(*parse_settings(model(), "", settings));
  auto prepared = narrow<Real>(from_numbers<deon::Deon<float>>(numbers.data()));
  prepared.beta_m = Real(row.number("beta_m"));
  prepared.sin_alpha = Real(std::sin(row.number("alpha")));
  prepared.cos_alpha = Real(std::cos(row.number("alpha")));
  return prepared;
}

/// Over the table: the largest error as a share of what rounding of the inputs allows, and relative to the value.
struct WorstOfTable {
  double ratio = 0, relative = 0;
};
template <class Real>
WorstOfTable worst_of_non_separable() {
  WorstOfTable worst;
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/bsdf/deon/reference/non_separable.csv")) {
    const double truth = row.number("m"), i = row.number("theta_i"), o = row.number("theta_o"), phi = row.number("phi");
    const EvaluationPoint<double> at{i, o, 0, phi, 0, 0};
    const auto formula = [](const auto& numbers, int, int, const auto& point) {
      return glm::vec<3, std::decay_t<decltype(point.phi)>>(non_separable_of(numbers, point));
    };
    const double kappa = tests::condition_number(prepared_of<double>(row), 0, 0, at, formula).kappa;
    const EvaluationPoint<Real> rounded{Real(i), Real(o), 0, Real(phi), 0, 0};
    const double error = std::abs(double(non_separable_of(prepared_of<Real>(row), rounded)) - truth) /
                         std::max(truth, double(std::numeric_limits<Real>::min()));
    worst.ratio = std::max(worst.ratio, error / tests::allowed_error<Real>(kappa));
    worst.relative = std::max(worst.relative, error);
  }
  return worst;
}

TEST(Deon, NonSeparableR_AgreesWithMpmathAsFarAsItsInputsAllow) {
  const WorstOfTable worst = worst_of_non_separable<double>();
  EXPECT_LE(worst.ratio, 1);
  EXPECT_LE(worst.relative, 1e-11);
}
TEST(Deon, NonSeparableRInFloat_AgreesWithMpmathAsFarAsItsInputsAllow) {
  const WorstOfTable worst = worst_of_non_separable<float>();
  std::printf("float: %.3g of what is allowed, %.3g relative\n", worst.ratio, worst.relative);
  EXPECT_LE(worst.ratio, 1);
}

TEST(Deon, IntegralOfN_IsHalfThatOfA) {
  for (const char* settings : {"beta_n=0.05", "beta_n=0.7,eta=1.2"})
    for (int lobe = 0; lobe < 4; ++lobe) {
      std::vector<Point> turn, across;
      const int count = 2000;
      for (int k = 0; k < count; ++k) {
        turn.push_back({.theta_d = 0.7, .phi = (k + 0.5) / count * 2 * pi - pi});
        across.push_back({.theta_d = 0.7, .h = std::sin((k + 0.5) / count * pi / 2)});
      }
      double n = 0, a = 0;
      const auto around = evaluate_at(settings, Quantity::N, lobe, turn),
                 shares = evaluate_at(settings, Quantity::A, lobe, across);
      for (int k = 0; k < count; ++k) {
        n += around[std::size_t(k)].x * 2 * pi / count;
        a += shares[std::size_t(k)].x * std::cos((k + 0.5) / count * pi / 2) * pi / 2 / count;
      }
      EXPECT_NEAR(n, a, 1e-6 * a) << settings << " lobe " << lobe;
    }
}

TEST(Deon, WhiteFibre_ScattersAll) {
  for (const char* settings : {"sigma_a=0", "sigma_a=0,beta_m=1,eta=1.1,r_lobe=non_separable"})
    for (double theta_o : {0.0, 0.6, 1.4, 1.5707})
      EXPECT_NEAR(value_at(settings, Quantity::albedo, -1, {.theta_o = theta_o}), 1, 1e-9)
          << settings << " " << theta_o;
}

/// The integral of S cos(theta_i) over all directions by products of midpoints.
double furnace(const std::string& settings, int lobe, double theta_o) {
  const int across = 240, around = 120;
  std::vector<Point> points;
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < around; ++k)
      points.push_back(
          {.theta_i = ((i + 0.5) / across - 0.5) * pi, .theta_o = theta_o, .phi = (k + 0.5) / around * pi});
  const auto values = evaluate_at(settings, Quantity::S, lobe, points);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += values[i].x * std::cos(points[i].theta_i) * 2 * pi * pi / (across * around);
  return sum;
}
TEST(Deon, WhiteFurnace_IsFullWhereAttenuationBelongsToThetaO) {
  EXPECT_NEAR(furnace("sigma_a=0,beta_m=0.5,beta_n=0.4,azimuthal_tolerance=1e-4", -1, 0.7), 1, 2e-4);
}
TEST(Deon, AlbedoAtThetaD_IsTheIntegralOfS) {
  const std::string settings = "sigma_a=0.5,beta_m=0.5,beta_n=0.4,azimuthal_tolerance=1e-4,attenuation_angle=theta_d";
  for (int lobe = 0; lobe < 4; ++lobe)
    EXPECT_NEAR(furnace(settings, lobe, 0.7), value_at(settings, Quantity::albedo, lobe, {.theta_o = 0.7}), 1e-4)
        << lobe;
}
TEST(Deon, AlbedoOfTheNonSeparableRAtThetaD_IsTheIntegralOfS) {
  const std::string settings =
      "beta_m=0.5,beta_n=0.4,azimuthal_tolerance=1e-3,attenuation_angle=theta_d,r_lobe=non_separable";
  EXPECT_NEAR(furnace(settings, 0, 0.7), value_at(settings, Quantity::albedo, 0, {.theta_o = 0.7}), 2e-3);
}

TEST(Deon, AtThetaDWithoutTilt_IsReciprocal) {
  const std::string settings = std::string("alpha=0,attenuation_angle=theta_d,") + fine;
  for (double phi : {0.1, 1.0, 3.0}) {
    const double forth = value_at(settings, Quantity::S, -1, {.theta_i = 0.5, .theta_o = -0.9, .phi = phi});
    const double back = value_at(settings, Quantity::S, -1, {.theta_i = -0.9, .theta_o = 0.5, .phi = -phi});
    EXPECT_NEAR(forth, back, 1e-11 * forth);
  }
}

/// theta_i at which S of the lobe is largest, in steps of 1e-3.
double peak(const std::string& settings, int lobe, double theta_o, double phi) {
  std::vector<Point> points;
  for (int i = -1500; i <= 1500; ++i) points.push_back({.theta_i = i * 1e-3, .theta_o = theta_o, .phi = phi});
  const auto values = evaluate_at(settings, Quantity::S, lobe, points);
  const auto largest = std::max_element(values.begin(), values.end(), [](auto a, auto b) { return a.x < b.x; });
  return points[std::size_t(largest - values.begin())].theta_i;
}
TEST(Deon, PeaksOfTheLobes_AreShiftedByTheTilt) {
  const std::string settings = "beta_m=0.02,alpha=-0.06";
  EXPECT_NEAR(peak(settings, 0, 0.3, 1), -0.3 - 0.12, 2e-3);
  EXPECT_NEAR(peak(settings, 1, 0.3, 3), -0.3 + 0.06, 2e-3);
  EXPECT_NEAR(peak(settings, 2, 0.3, 1), -0.3 + 0.18, 2e-3);
}
TEST(Deon, ShiftOfTheNonSeparableR_ShrinksWithTheCosineOfHalfTheAzimuth) {
  const std::string settings = "beta_m=0.02,alpha=-0.06,r_lobe=non_separable";
  EXPECT_NEAR(peak(settings, 0, 0, 0), -0.12, 2e-3);
  EXPECT_NEAR(peak(settings, 0, 0, 2 * pi / 3), -0.06, 2e-3);
}

TEST(Deon, Lobes_AddUpToTheSum) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .theta_d = 0.1, .phi = 2.9, .h = 0.4};
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::albedo, Quantity::error}) {
    double sum = 0;
    for (int lobe = 0; lobe < 4; ++lobe) sum += value_at("", quantity, lobe, point);
    EXPECT_DOUBLE_EQ(value_at("", quantity, -1, point), sum);
  }
}

/// Settings and points that are hard, or drawn over the whole domain by a fixed seed.
std::string hard_settings(std::mt19937& random) {
  constexpr std::array<double, 4> etas = {1.05, 1.55, 2, 3}, sigmas = {0, 0.2, 5, 100}, betas = {1e-3, 0.02, 0.3, 1},
                                  alphas = {-0.17, 0, 0.05, 0.17};
  return fmt::format(
      "eta={},sigma_a={},beta_m={},beta_n={},alpha={},azimuthal_tolerance=1e-3,r_lobe={},attenuation_angle={}",
      tests::pick(random, etas), tests::pick(random, sigmas), tests::pick(random, betas), tests::pick(random, betas),
      tests::pick(random, alphas), random() % 2 ? "separable" : "non_separable", random() % 2 ? "theta_o" : "theta_d");
}

class DeonDomain : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(Precisions, DeonDomain, testing::Values(Precision::f32, Precision::f64));
TEST_P(DeonDomain, EveryValue_IsFiniteAndNotNegative) {
  std::mt19937 random(20110627);
  for (int set = 0; set < 60; ++set) {
    const std::string settings = hard_settings(random);
    const std::vector<Point> points = tests::hard_points(random, 20);
    for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::pdf, Quantity::error})
      for (int lobe = -1; lobe < 4; ++lobe)
        tests::expect_finite_and_not_negative(evaluate_at, settings, quantity, lobe, points, GetParam());
  }
}

struct Refusal {
  const char* settings;
  const char* words;
};
class DeonParameters : public testing::TestWithParam<Refusal> {};
INSTANTIATE_TEST_SUITE_P(Bad, DeonParameters,
                         testing::Values(Refusal{"eta=1", "eta"}, Refusal{"beta_m=0", "beta_m"},
                                         Refusal{"beta_n=nan", "beta_n"}, Refusal{"sigma_a=101", "sigma_a"},
                                         Refusal{"azimuthal_tolerance=0", "azimuthal_tolerance"},
                                         Refusal{"r_lobe=both", "non_separable"}));
TEST_P(DeonParameters, OutOfRange_AreRefusedByName) {
  const auto values = parse_settings(model(), "", GetParam().settings);
  ASSERT_FALSE(values.ok());
  EXPECT_THAT(values.error().message, HasSubstr(GetParam().words));
}

TEST(Deon, Fibre_MapsToItsOwnDeviationsAndTilt) {
  const FibreMapping mapping = model().from_fibre({.scale_tilt = 0.05, .azimuthal_deviation = 0.3});
  const auto values = parse_settings(model(), "", mapping.settings);
  ASSERT_TRUE(values.ok());
  EXPECT_EQ(values->real("alpha"), -0.05);
  EXPECT_EQ(values->real("beta_n"), 0.3);
}
TEST(Deon, PresetsAndTiers_AreValid) {
  for (const registry::StudyCase& preset : model().presets)
    EXPECT_TRUE(parse_settings(model(), preset.name, "").ok()) << preset.name;
  for (const registry::StudyCase& tier : model().entry.study_cases)
    EXPECT_TRUE(parse_settings(model(), "", tier.settings).ok()) << tier.name;
}

}  // namespace
}  // namespace cuticle::bsdf::deon_test
