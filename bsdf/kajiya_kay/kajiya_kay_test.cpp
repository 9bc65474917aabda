// What Kajiya and Kay's model is known by; tables, densities and energies are in shared/empirical_models_test.cpp.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/model_values.h"

namespace cuticle::bsdf::kajiya_kay_test {
namespace {

constexpr double pi = std::numbers::pi;

double value(const std::string& settings, std::string_view lobe, const Point& point, Quantity quantity = Quantity::S) {
  return tests::model_value("kajiya_kay", settings, quantity, lobe, point).x;
}

TEST(KajiyaKay, Highlight_IsTheWholeConeOfReflection) {
  for (double phi : {0.0, 1.0, 3.1})
    EXPECT_DOUBLE_EQ(value("specular=0.3,exponent=80", "specular", {.theta_i = -0.4, .theta_o = 0.4, .phi = phi}), 0.3);
}

TEST(KajiyaKay, HighlightByItsExponent_HasHalfItsHeightAtTheAngleOfTheCosine) {
  const double half = std::acos(std::pow(0.5, 1 / 80.0));
  EXPECT_NEAR(value("specular=1,exponent=80", "specular", {.theta_i = 0.2 + half, .theta_o = -0.2}), 0.5, 1e-14);
}

TEST(KajiyaKay, Diffuse_VanishesForLightAlongTheFibre) {
  EXPECT_NEAR(value("diffuse=1", "diffuse", {.theta_i = pi / 2, .theta_o = 0.3}), 0, 1e-16);
  EXPECT_DOUBLE_EQ(value("diffuse=0.7", "diffuse", {.theta_i = 0, .theta_o = 0.3, .phi = 3}), 0.7);
}

TEST(KajiyaKay, LightBehindTheConeByARightAngle_GivesNoHighlight) {
  EXPECT_EQ(value("exponent=1", "specular", {.theta_i = 1, .theta_o = 0.6}), 0);
}

TEST(KajiyaKay, Reciprocity_HoldsForTheHighlightOnly) {
  const Point forth{.theta_i = 0.3, .theta_o = -0.9, .phi = 1}, back{.theta_i = -0.9, .theta_o = 0.3, .phi = -1};
  EXPECT_DOUBLE_EQ(value("", "specular", forth), value("", "specular", back));
  EXPECT_GT(value("", "diffuse", forth), 1.5 * value("", "diffuse", back));
}

TEST(KajiyaKay, DiffuseAlbedo_IsPiSquared) {
  EXPECT_DOUBLE_EQ(value("diffuse=1", "diffuse", {}, Quantity::albedo), pi * pi);
}

TEST(KajiyaKay, BadParameters_AreRefusedByName) {
  const Model& model = **find_model("kajiya_kay");
  for (const char* settings : {"exponent=0.5", "exponent=nan", "diffuse=-0.1", "specular=11"}) {
    const auto values = parse_settings(model, "", settings);
    ASSERT_FALSE(values.ok()) << settings;
    EXPECT_THAT(values.error().message, testing::HasSubstr(std::string(settings).substr(0, 7)));
  }
}

}  // namespace
}  // namespace cuticle::bsdf::kajiya_kay_test
