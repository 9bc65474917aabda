// The Chiang model: energy, shifts, symmetries, near against far field, the whole domain, conversions.
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/chiang/conversions.h"
#include "bsdf/model.h"
#include "tests/support/hard_cases.h"

namespace cuticle::bsdf::chiang_test {
namespace {

constexpr double pi = std::numbers::pi;

const Model& model() { return **find_model("chiang"); }
double value(const std::string& settings, Quantity quantity, std::string_view lobe, const Point& point) {
  return tests::model_value("chiang", settings, quantity, lobe, point).x;
}
constexpr tests::ValuesOf values_at{"chiang"};

/// The integral of a quantity times cos(theta_i) over theta_i and phi, by midpoints; red.
double sphere_integral(const std::string& settings, Quantity quantity, int lobe, double theta_o, double h, int across,
                       int around) {
  std::vector<Point> points;
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < around; ++k)
      points.push_back({.theta_i = ((i + 0.5) / across - 0.5) * pi,
                        .theta_o = theta_o,
                        .phi = ((k + 0.5) / around * 2 - 1) * pi,
                        .h = h});
  double sum = 0;
  const auto values = values_at(settings, quantity, lobe, points);
  for (std::size_t i = 0; i < points.size(); ++i) sum += values[i].x * std::cos(points[i].theta_i);
  return sum * pi / across * 2 * pi / around;
}

TEST(Chiang, WhiteFibre_ScattersEverythingAtEveryOffset) {
  for (double theta_o : {0.0, 0.7, -1.3, 1.5707})
    for (double h : {-0.999, -0.3, 0.0, 0.8})
      EXPECT_NEAR(value("sigma_a=0,field=near", Quantity::albedo, "sum", {.theta_o = theta_o, .h = h}), 1, 1e-13);
}
TEST(Chiang, WhiteFibreInTheFarField_ScattersEverything) {
  for (double theta_o : {0.0, 0.7, -1.3, 1.5707})
    EXPECT_NEAR(value("sigma_a=0", Quantity::albedo, "sum", {.theta_o = theta_o}), 1, 1e-5);
}

struct Place {
  const char* settings;
  double theta_o, h;
};
class ChiangIntegral : public testing::TestWithParam<Place> {};
INSTANTIATE_TEST_SUITE_P(Tilted, ChiangIntegral,
                         testing::Values(Place{"field=near,beta_m=0.4,beta_n=0.4,alpha=0.1", 0.6, 0.3},
                                         Place{"field=near,beta_m=0.5,beta_n=0.3,alpha=-0.17", -1.4, -0.9},
                                         Place{"field=near,beta_m=1,beta_n=1,alpha=0.17", 1.56, 0.99},
                                         Place{"field=near,beta_m=0.25,beta_n=0.25,alpha=0.17,sigma_a=3", 0, 0}));
TEST_P(ChiangIntegral, OfS_IsTheAlbedo) {
  const auto [settings, theta_o, h] = GetParam();
  for (int lobe = -1; lobe < 4; ++lobe) {
    const std::string_view name = lobe < 0 ? "sum" : model().lobes[std::size_t(lobe)];
    EXPECT_NEAR(sphere_integral(settings, Quantity::S, lobe, theta_o, h, 400, 300),
                value(settings, Quantity::albedo, name, {.theta_o = theta_o, .h = h}), 1e-5)
        << name;
  }
}
TEST_P(ChiangIntegral, OfThePdfOfEachLobe_IsOne) {
  const auto [settings, theta_o, h] = GetParam();
  for (int lobe = -1; lobe < 4; ++lobe)
    EXPECT_NEAR(sphere_integral(settings, Quantity::pdf, lobe, theta_o, h, 400, 300), 1, 2e-5) << lobe;
}
TEST(ChiangFarField, IntegralsOfSAndPdf_AreAlbedoAndOne) {
  const std::string settings = "beta_m=0.5,beta_n=0.5,alpha=0.1,tolerance=1e-4";
  EXPECT_NEAR(sphere_integral(settings, Quantity::S, -1, 0.5, 0, 40, 36),
              value(settings, Quantity::albedo, "sum", {.theta_o = 0.5}), 3e-4);
  EXPECT_NEAR(sphere_integral(settings, Quantity::pdf, -1, 0.5, 0, 40, 36), 1, 3e-4);
  EXPECT_NEAR(sphere_integral(settings, Quantity::pdf, 1, 0.5, 0, 40, 36), 1, 3e-4);
}

TEST(Chiang, AzimuthalTerm_IntegratesToTheAttenuation) {
  for (int lobe = 0; lobe < 4; ++lobe) {
    std::vector<Point> points;
    for (int k = 0; k < 4000; ++k)
      points.push_back({.theta_d = 0.4, .phi = ((k + 0.5) / 4000 * 2 - 1) * pi, .h = -0.6});
    double sum = 0;
    for (const glm::dvec3& n : values_at("field=near", Quantity::N, lobe, points)) sum += n.x * 2 * pi / 4000;
    EXPECT_NEAR(sum, values_at("", Quantity::A, lobe, {points[0]})[0].x, 1e-6) << lobe;
  }
}

// R at theta_i + theta_o = -2 alpha: scales that lean to the tip throw it to the root.
TEST(Chiang, PeaksOfNarrowLobes_AreShiftedByTheTilt) {
  const std::array<double, 4> shift = {-2, 1, 4, 0};
  for (int lobe = 0; lobe < 4; ++lobe) {
    const double at = shift[std::size_t(lobe)] * 0.05 - 0.3;
    const auto around = values_at("beta_m=0.02,alpha=0.05", Quantity::M, lobe,
                                  {{.theta_i = at - 0.004, .theta_o = 0.3},
                                   {.theta_i = at, .theta_o = 0.3},
                                   {.theta_i = at + 0.004, .theta_o = 0.3}});
    EXPECT_GT(around[1].x, around[0].x) << lobe;
    EXPECT_GT(around[1].x, around[2].x) << lobe;
  }
}
// The viewer's ray meets the fibre at azimuth phi_o + asin h, and R leaves by the mirror direction: phi = -2 asin h.
TEST(Chiang, ReflectionOffTheSide_LeavesByTheMirrorDirection) {
  const double phi = -2 * std::asin(0.5);
  const std::string settings = "field=near,beta_n=0.05";
  EXPECT_GT(value(settings, Quantity::N, "R", {.phi = phi, .h = 0.5}),
            3 * value(settings, Quantity::N, "R", {.phi = phi + 0.1, .h = 0.5}));
  EXPECT_GT(value(settings, Quantity::N, "R", {.phi = phi, .h = 0.5}),
            3 * value(settings, Quantity::N, "R", {.phi = phi - 0.1, .h = 0.5}));
}

TEST(Chiang, Lobes_AddUpToTheSum) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .theta_d = 0.1, .phi = 2.9, .h = 0.4};
  for (const char* field : {"field=near", "field=far,tolerance=1e-9"})
    for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::albedo}) {
      double sum = 0;
      for (std::string_view lobe : model().lobes) sum += value(field, quantity, lobe, point);
      EXPECT_NEAR(value(field, quantity, "sum", point), sum, 1e-8 * sum) << field << int(quantity);
    }
}
TEST(Chiang, MirroredOffsetAndAzimuth_GiveTheSameValue) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .phi = 2.1, .h = 0.4},
      mirrored{.theta_i = 0.2, .theta_o = -0.3, .phi = -2.1, .h = -0.4};
  EXPECT_DOUBLE_EQ(value("field=near", Quantity::S, "sum", point), value("field=near", Quantity::S, "sum", mirrored));
}

TEST(ChiangFarField, OverASliverOfOffsets_IsTheNearField) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .phi = 2.1, .h = 0.4};
  for (Quantity quantity : {Quantity::S, Quantity::N, Quantity::pdf, Quantity::albedo}) {
    const double near = value("field=near", quantity, "sum", point);
    EXPECT_NEAR(value("h_from=0.3999999,h_to=0.4000001", quantity, "sum", point), near, 1e-7 * near) << int(quantity);
  }
}
TEST(ChiangFarField, OverTwoHalves_AveragesToTheWhole) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .phi = 2.1};
  const double low = value("h_to=0.25,tolerance=1e-9", Quantity::S, "sum", point),
               high = value("h_from=0.25,tolerance=1e-9", Quantity::S, "sum", point);
  const double whole = value("tolerance=1e-9", Quantity::S, "sum", point);
  EXPECT_NEAR(low * 0.625 + high * 0.375, whole, 1e-8 * whole);
}
TEST(ChiangFarField, EmptyInterval_IsZeroAndReversedOneTheSame) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .phi = 2.1};
  EXPECT_EQ(value("h_from=0.5,h_to=0.5", Quantity::S, "sum", point), 0);
  EXPECT_EQ(value("h_from=0.5,h_to=-0.5", Quantity::S, "sum", point),
            value("h_from=-0.5,h_to=0.5", Quantity::S, "sum", point));
}
// At the smallest roughness D_p is a spike of 2e-4 rad; the mean over phi still is the attenuation.
TEST(ChiangFarField, NarrowestRoughness_LosesNoPeak) {
  double sum = 0;
  std::vector<Point> points;
  for (int k = 0; k < 1200; ++k) points.push_back({.theta_d = 0.3, .phi = ((k + 0.37) / 1200 * 2 - 1) * pi});
  for (const glm::dvec3& n : values_at("beta_n=0.001", Quantity::N, 0, points)) sum += n.x * 2 * pi / 1200;
  EXPECT_NEAR(sum, value("", Quantity::albedo, "R", {.theta_o = 0.3}), 1e-4);
}

std::string hard_settings(std::mt19937& random, const char* field) {
  constexpr std::array<double, 4> etas = {1.05, 1.55, 2, 3}, sigmas = {0, 0.2, 5, 100}, betas = {1e-3, 0.02, 0.3, 1},
                                  alphas = {-0.17, 0, 0.05, 0.17};
  return fmt::format("eta={},sigma_a={},beta_m={},beta_n={},alpha={},field={}", tests::pick(random, etas),
                     tests::pick(random, sigmas), tests::pick(random, betas), tests::pick(random, betas),
                     tests::pick(random, alphas), field);
}
void expect_finite(int sets, int points_each, const char* field, Precision precision) {
  std::mt19937 random(2016);
  for (int set = 0; set < sets; ++set) {
    const std::string settings = hard_settings(random, field);
    const std::vector<Point> points = tests::hard_points(random, points_each);
    for (std::size_t quantity = 0; quantity < quantity_count; ++quantity)
      for (int lobe = -1; lobe < 4; ++lobe)
        tests::expect_finite_and_not_negative({"chiang"}, settings, Quantity(quantity), lobe, points, precision);
  }
}
class ChiangDomain : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(Precisions, ChiangDomain, testing::Values(Precision::f32, Precision::f64));
TEST_P(ChiangDomain, EveryNearValue_IsFiniteAndNotNegative) { expect_finite(100, 200, "near", GetParam()); }
TEST_P(ChiangDomain, EveryFarValue_IsFiniteAndNotNegative) { expect_finite(12, 4, "far", GetParam()); }

TEST(ChiangConversions, Roughness_GoesThereAndBack) {
  for (double beta : {0.001, 0.05, 0.3, 0.9, 1.0}) {
    EXPECT_NEAR(chiang::beta_m_from_deviation(chiang::deviation_from_beta_m(beta)), beta, 1e-14);
    EXPECT_NEAR(chiang::beta_n_from_scale(chiang::scale_from_beta_n(beta)), beta, 1e-14);
  }
  EXPECT_NEAR(chiang::deviation_from_beta_m(0.3), 0.726 * 0.3 + 0.812 * 0.09, 1e-9);
}
TEST(ChiangConversions, SignsOfOtherRenderers_AreNamed) {
  EXPECT_EQ(chiang::alpha_from_pbrt(0.03), -0.03);
  EXPECT_EQ(chiang::alpha_from_tungsten(0.03), -0.03);
  EXPECT_EQ(chiang::alpha_from_pbrt_before_2019(0.03), 0.03);
  EXPECT_EQ(chiang::alpha_to_pbrt(chiang::alpha_from_pbrt(0.03)), 0.03);
  EXPECT_EQ(chiang::offset_from_pbrt(0.5), -0.5);
}
TEST(ChiangFibre, Deviations_BecomeThoseOfTheRLobe) {
  const FibreMapping mapping = model().from_fibre({.longitudinal_deviation = 0.1, .azimuthal_deviation = 0.15});
  const auto values = parse_settings(model(), "", mapping.settings);
  ASSERT_TRUE(values.ok());
  EXPECT_NEAR(chiang::deviation_from_beta_m(values->real("beta_m")), 0.1, 1e-12);
  EXPECT_NEAR(chiang::scale_from_beta_n(values->real("beta_n")) * pi / std::sqrt(3), 0.15, 1e-12);
  EXPECT_FALSE(mapping.words.empty());
}

class ChiangRefusal : public testing::TestWithParam<std::array<const char*, 2>> {};
INSTANTIATE_TEST_SUITE_P(Bad, ChiangRefusal,
                         testing::Values(std::array{"beta_m=0", "beta_m"}, std::array{"beta_n=1.1", "beta_n"},
                                         std::array{"h_from=-2", "h_from"}, std::array{"field=middle", "near"},
                                         std::array{"tolerance=0", "tolerance"}));
TEST_P(ChiangRefusal, SettingsOutOfRange_AreRefusedByName) {
  const auto values = parse_settings(model(), "", GetParam()[0]);
  ASSERT_FALSE(values.ok());
  EXPECT_THAT(values.error().message, testing::HasSubstr(GetParam()[1]));
}
TEST(Chiang, PresetsAndTiers_AreValid) {
  for (const registry::StudyCase& preset : model().presets)
    EXPECT_TRUE(parse_settings(model(), preset.name, "").ok()) << preset.name;
  for (const registry::StudyCase& tier : model().entry.study_cases)
    EXPECT_TRUE(parse_settings(model(), "", tier.settings).ok()) << tier.name;
}

}  // namespace
}  // namespace cuticle::bsdf::chiang_test
