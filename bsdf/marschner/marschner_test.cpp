// The corrected Marschner model: tables by mpmath, invariants, hard cases, bad parameters.
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "tests/support/csv_table.h"
#include "tests/support/hard_cases.h"

namespace cuticle::bsdf::marschner_test {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

const Model& model() { return **find_model("marschner"); }

constexpr tests::ValuesOf evaluate_at{"marschner"};
constexpr tests::ValueOf value_at{"marschner"};

TEST(Marschner, Azimuthal_AgreesWithMpmath) {
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/bsdf/marschner/reference/azimuthal.csv")) {
    const std::string settings = fmt::format("eta={},sigma_a=0.2", row.text("eta"));
    const Point point{.theta_d = row.number("theta_d"), .phi = row.number("phi")};
    const double truth = row.number("n");
    EXPECT_NEAR(value_at(settings, Quantity::N, int(row.number("lobe")), point), truth, 1e-14 * std::max(truth, 0.01))
        << settings;
  }
}

TEST(Marschner, FloatAzimuthal_AgreesWithDoubleAwayFromCaustics) {
  for (double eta : {1.3, 1.55, 1.9})
    for (double theta_d : {0.0, 30.0, 60.0}) {
      std::vector<Point> points;
      const double bent = std::sqrt(eta * eta - std::pow(std::sin(theta_d * degree), 2)) / std::cos(theta_d * degree);
      const double h = std::sqrt(std::max(0.0, 4 - bent * bent) / 3);
      const double caustic = std::abs(4 * std::asin(h / bent) - 2 * std::asin(h));
      for (int i = 0; i <= 720; ++i)
        if (std::abs(i * 0.25 * degree - caustic) > 0.5 * degree)
          points.push_back({.theta_d = theta_d * degree, .phi = i * 0.25 * degree});
      for (int lobe = 0; lobe < 3; ++lobe) {
        const std::string settings = fmt::format("eta={}", eta);
        const auto truth = evaluate_at(settings, Quantity::N, lobe, points);
        const auto single = evaluate_at(settings, Quantity::N, lobe, points, Precision::f32);
        double largest = 0, worst = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
          largest = std::max(largest, truth[i].x);
          worst = std::max(worst, std::abs(truth[i].x - single[i].x));
        }
        EXPECT_LE(worst, 1e-5 * largest) << settings << " " << theta_d << " " << lobe;
      }
    }
}

// h_c^2 = (4 - eta^2) / 3 at normal incidence: phi_c = 18.62 degrees for 1.55, where the cubic of the paper has 20.49.
TEST(Marschner, CausticOfTrt_IsAtItsAnalyticAzimuth) {
  const double h = std::sqrt((4 - 1.55 * 1.55) / 3), peak = std::abs(4 * std::asin(h / 1.55) - 2 * std::asin(h));
  EXPECT_NEAR(peak / degree, 18.62, 0.005);
  EXPECT_GT(value_at("", Quantity::N, 2, {.phi = peak - 1e-6}),
            10 * value_at("", Quantity::N, 2, {.phi = peak - 0.01}));
  EXPECT_LT(value_at("", Quantity::N, 2, {.phi = peak + 1e-6}), 0.01);
}

// The smooth model is infinite there; the value given is that of a point 1e-4 away in h, so no larger than 1e-4 makes
// it.
TEST(Marschner, ValueAtTheCaustic_IsThatOfTheMargin) {
  for (double eta : {1.05, 1.3, 1.55, 1.9}) {
    const double h = std::sqrt((4 - eta * eta) / 3), gamma_t = std::asin(h / eta),
                 peak = 4 * gamma_t - 2 * std::asin(h);
    const double curvature =
        4 * h / std::pow(eta * std::cos(gamma_t), 3) - 2 * h / std::pow(1 - h * h, 1.5);  // of phi(2, h)
    const double attenuation = value_at(fmt::format("eta={}", eta), Quantity::A, 2, {.h = h});
    const double both_sides = 2 * attenuation / std::abs(2 * curvature * 1e-4);
    EXPECT_NEAR(value_at(fmt::format("eta={}", eta), Quantity::N, 2, {.phi = peak - 1e-13}), both_sides,
                0.1 * both_sides)
        << eta;
  }
}

// Crossing phi = 0 exchanges the roots of one half of the fibre with those of the other.
TEST(Marschner, RegionOfThreeRoots_IsContinuousAcrossZero) {
  const double before = value_at("", Quantity::N, 2, {.phi = -1e-9}), at = value_at("", Quantity::N, 2, {.phi = 0}),
               after = value_at("", Quantity::N, 2, {.phi = 1e-9});
  EXPECT_NEAR(before, at, 1e-8 * at);
  EXPECT_NEAR(after, at, 1e-8 * at);
}

TEST(Marschner, WholeTurns_ChangeNothing) {
  for (int lobe = 0; lobe < 3; ++lobe)
    EXPECT_NEAR(value_at("", Quantity::N, lobe, {.phi = 0.25 + 4 * pi}), value_at("", Quantity::N, lobe, {.phi = 0.25}),
                1e-12);
}

TEST(Marschner, Lobes_AddUpToTheSum) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .theta_d = 0.1, .phi = 2.9, .h = 0.4};
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::albedo}) {
    double sum = 0;
    for (int lobe = 0; lobe < 3; ++lobe) sum += value_at("", quantity, lobe, point);
    EXPECT_DOUBLE_EQ(value_at("", quantity, -1, point), sum);
  }
}

TEST(Marschner, WithoutTilt_IsReciprocal) {
  for (double phi : {0.1, 1.0, 3.0}) {
    const double forth = value_at("alpha=0", Quantity::S, -1, {.theta_i = 0.5, .theta_o = -0.9, .phi = phi});
    const double back = value_at("alpha=0", Quantity::S, -1, {.theta_i = -0.9, .theta_o = 0.5, .phi = -phi});
    EXPECT_NEAR(forth, back, 1e-13 * forth);
  }
}

// Without absorption, tilt and width, the lobes leave out only the paths of more than one inner reflection.
TEST(Marschner, WhiteFibre_ScattersAllButTheHigherOrders) {
  for (double theta_o : {0.0, 0.5, 1.2}) {
    const double albedo = value_at("sigma_a=0,alpha=0,beta=0.001", Quantity::albedo, -1, {.theta_o = theta_o});
    EXPECT_LT(albedo, 1);
    EXPECT_GT(albedo, 0.95);
  }
}

TEST(Marschner, Albedo_IsTheIntegralOfS) {
  const std::string settings = "sigma_a=0.3,beta=0.4";
  const int across = 400, around = 400;
  std::vector<Point> points;
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < around; ++k)
      points.push_back({.theta_i = ((i + 0.5) / across - 0.5) * pi, .theta_o = 0.6, .phi = (k + 0.5) / around * pi});
  for (int lobe : {0, 1}) {
    const std::vector<glm::dvec3> values = evaluate_at(settings, Quantity::S, lobe, points);
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      sum += values[i].x * std::cos(points[i].theta_i) * 2 * pi * pi / (across * around);
    EXPECT_NEAR(sum, value_at(settings, Quantity::albedo, lobe, {.theta_o = 0.6}), 2e-5) << lobe;
  }
}

/// Points and settings that are hard, or drawn over the whole domain by a fixed seed.
std::string hard_settings(std::mt19937& random) {
  constexpr std::array<double, 4> etas = {1.05, 1.55, 2, 3}, sigmas = {0, 0.2, 5, 100}, betas = {1e-3, 0.02, 0.3, 1},
                                  alphas = {-0.17, 0, 0.05, 0.17};
  return fmt::format("eta={},sigma_a={},beta={},alpha={}", tests::pick(random, etas), tests::pick(random, sigmas),
                     tests::pick(random, betas), tests::pick(random, alphas));
}

class MarschnerDomain : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(Precisions, MarschnerDomain, testing::Values(Precision::f32, Precision::f64));
TEST_P(MarschnerDomain, EveryValue_IsFiniteAndNotNegative) {
  std::mt19937 random(20030727);
  for (int set = 0; set < 100; ++set) {
    const std::string settings = hard_settings(random);
    const std::vector<Point> points = tests::hard_points(random, 300);
    for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A})
      for (int lobe = 0; lobe < 3; ++lobe)
        tests::expect_finite_and_not_negative(evaluate_at, settings, quantity, lobe, points, GetParam());
  }
}

TEST(Marschner, AlbedoAtTheEdges_IsFinite) {
  for (const char* settings : {"beta=0.001,sigma_a=100", "beta=1,sigma_a=0,eta=1.05", "alpha=0.17,beta=0.3"})
    for (double theta_o : {-pi / 2, 0.0, pi / 2}) {
      const double albedo = value_at(settings, Quantity::albedo, -1, {.theta_o = theta_o});
      EXPECT_TRUE(albedo >= 0 && albedo < 1.5) << settings;
    }
}

struct Refusal {
  const char* settings;
  const char* words;
};
class MarschnerParameters : public testing::TestWithParam<Refusal> {};
INSTANTIATE_TEST_SUITE_P(Bad, MarschnerParameters,
                         testing::Values(Refusal{"eta=1", "eta"}, Refusal{"eta=nan", "eta"}, Refusal{"beta=0", "beta"},
                                         Refusal{"sigma_a=-1", "sigma_a"}, Refusal{"alpha=0.3", "alpha"},
                                         Refusal{"alpha_deg=11", "alpha_deg"}, Refusal{"variant=wrong", "corrected"},
                                         Refusal{"etta=1.5", "etta"}));
TEST_P(MarschnerParameters, OutOfRange_AreRefusedByName) {
  const auto values = parse_settings(model(), "", GetParam().settings);
  ASSERT_FALSE(values.ok());
  EXPECT_THAT(values.error().message, HasSubstr(GetParam().words));
}

TEST(Marschner, Presets_AreValidAndGoBelowTheSettings) {
  for (const registry::StudyCase& preset : model().presets)
    EXPECT_TRUE(parse_settings(model(), preset.name, "").ok()) << preset.name;
  EXPECT_EQ(parse_settings(model(), "blond", "eta=1.4")->real("eta"), 1.4);
  EXPECT_EQ(parse_settings(model(), "blond", "eta=1.4")->rgb("sigma_a"), glm::dvec3(0.1257, 0.2091, 0.411));
}

TEST(Evaluate, PointOutsideTheDomain_IsRefusedByIndexAndName) {
  const std::vector<Point> points = {{}, {.theta_o = std::nan("")}};
  std::vector<glm::dvec3> out(2);
  const auto done = evaluate(model(), registry::default_values(model().entry.parameters), Precision::f64,
                             {Quantity::S, -1, points}, out);
  ASSERT_FALSE(done.ok());
  EXPECT_THAT(done.error().message, AllOf(HasSubstr("point 1"), HasSubstr("theta_o")));
}

TEST(FindModel, Misspelt_OffersTheNearest) { EXPECT_THAT(find_model("marschnr").error().hint, HasSubstr("marschner")); }
TEST(FindLobe, Unknown_ListsTheLobes) { EXPECT_THAT(find_lobe(model(), "TTT").error().message, HasSubstr("TRT")); }
TEST(FindQuantity, Unknown_ListsTheQuantities) { EXPECT_THAT(find_quantity("Q").error().message, HasSubstr("albedo")); }

}  // namespace
}  // namespace cuticle::bsdf::marschner_test
