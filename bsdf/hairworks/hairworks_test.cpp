// The features of HairWorks' shading. Labels: H13 H14.
#define GLM_FORCE_XYZW_ONLY
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/hairworks/hairworks.glslh"

#include "tests/support/model_values.h"

namespace cuticle::bsdf::hairworks_test {
namespace {

constexpr double pi = std::numbers::pi;

double value(const std::string& settings, std::string_view lobe, const Point& point, Quantity quantity = Quantity::S) {
  return tests::model_value("hairworks", settings, quantity, lobe, point).x;
}

/// Half the width in theta_i of a lobe at half its height, from its peak at theta_i = `peak`.
double half_width(const std::string& settings, std::string_view lobe, double peak) {
  const double height = value(settings, lobe, {.theta_i = peak});
  double low = 0, high = 1.4;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (value(settings, lobe, {.theta_i = peak + middle}) > 0.5 * height ? low : high) = middle;
  }
  return low;
}

// H13
TEST(HairWorks, PrimaryHighlight_IsKajiyaAndKays) {
  for (double theta_i : {-0.6, -0.3, 0.1})
    EXPECT_NEAR(value("specular_color=0.3,exponent=40", "primary", {.theta_i = theta_i, .theta_o = 0.3, .phi = 2}),
                tests::model_value("kajiya_kay", "specular=0.3,exponent=40", Quantity::S, "specular",
                                   {.theta_i = theta_i, .theta_o = 0.3, .phi = 2})
                    .x,
                1e-15);
}

// H13
TEST(HairWorks, SecondaryHighlight_IsWeakerWiderAndShifted) {
  const std::string settings =
      "specular_color=0.4,exponent=400,secondary_scale=0.25,secondary_width=3,secondary_shift=0.2";
  EXPECT_DOUBLE_EQ(value(settings, "secondary", {.theta_i = 0.2}), 0.25 * value(settings, "primary", {}));
  EXPECT_NEAR(half_width(settings, "secondary", 0.2) / half_width(settings, "primary", 0), 3, 0.03);
  EXPECT_LT(value(settings, "secondary", {.theta_i = -0.1}), value(settings, "secondary", {.theta_i = 0.5}) * 1.0001);
}

// H13: no setting makes the secondary highlight stronger or narrower.
TEST(HairWorks, SecondaryStrongerOrNarrower_IsRefused) {
  const Model& model = **find_model("hairworks");
  EXPECT_FALSE(parse_settings(model, "", "secondary_scale=1.1").ok());
  EXPECT_FALSE(parse_settings(model, "", "secondary_width=0.9").ok());
}

// H14
TEST(HairWorks, DiffuseWithoutBlend_IsTheStrandsTangent) {
  EXPECT_NEAR(value("tip_color=1,diffuse_blend=0", "diffuse", {.theta_i = 0.8, .phi = 2.5}), std::cos(0.8), 1e-15);
}

// H14
TEST(HairWorks, DiffuseFullyBlended_IsTheBodysLambertTerm) {
  const std::string body = "tip_color=1,diffuse_blend=1,normal_theta=0.5,normal_phi=-0.7";
  const double toward = std::sin(0.5) * std::sin(0.3) + std::cos(0.5) * std::cos(0.3) * std::cos(1.1 - 0.7);
  EXPECT_NEAR(value(body, "diffuse", {.theta_i = 0.3, .phi = 1.1}), toward, 1e-15);
  EXPECT_EQ(value(body, "diffuse", {.theta_i = 0.3, .phi = -2.4}), 0) << "light from behind the body";
}

// H14
TEST(HairWorks, Blend_IsLinearBetweenBoth) {
  const Point point{.theta_i = 0.3, .phi = 0.8};
  const std::string normal = ",normal_theta=0.2,normal_phi=0.5";
  const double tangent = value("diffuse_blend=0" + normal, "diffuse", point);
  const double body = value("diffuse_blend=1" + normal, "diffuse", point);
  EXPECT_NEAR(value("diffuse_blend=0.3" + normal, "diffuse", point), 0.7 * tangent + 0.3 * body, 1e-16);
}

// H14: at its root a strand that takes colour and normal of the skin is lit as the skin is, whichever way it leans, so
// thin spots do not show.
TEST(HairWorks, RootOfABlendedStrand_IsLitAsTheSkin) {
  const glm::dvec3 skin(0.6, 0.4, 0.3);
  for (double lean :
       {0.0, 0.4, 1.2}) {      // of the strand's normal plane from the skin's normal, in the plane of the light
    const double light = 0.7;  // angle between light and the skin's normal
    const std::string settings =
        "root_color=0.6/0.4/0.3,tip_color=0.1,along=0,diffuse_blend=1,normal_theta=" + std::to_string(lean);
    const Point point{.theta_i = lean - light};
    const glm::dvec3 shaded = tests::model_value("hairworks", settings, Quantity::S, "diffuse", point);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shaded[c], skin[c] * std::cos(light), 1e-12) << lean;
  }
}

// H14
TEST(HairWorks, Colour_GoesFromTheRootsToTheTipsWithinItsReach) {
  const std::string colors = "root_color=0.8,tip_color=0.2,root_reach=0.5,along=";
  EXPECT_DOUBLE_EQ(value(colors + "0", "diffuse", {}), 0.8);
  EXPECT_DOUBLE_EQ(value(colors + "0.25", "diffuse", {}), 0.5);
  EXPECT_DOUBLE_EQ(value(colors + "0.5", "diffuse", {}), 0.2);
  EXPECT_DOUBLE_EQ(value(colors + "1", "diffuse", {}), 0.2);
}

TEST(HairWorks, DiffuseAlbedo_IsItsClosedForm) {
  EXPECT_DOUBLE_EQ(value("tip_color=1,diffuse_blend=1", "diffuse", {.theta_o = 1}, Quantity::albedo), pi);
  EXPECT_DOUBLE_EQ(value("tip_color=1", "diffuse", {.theta_o = 1}, Quantity::albedo), pi * pi);
}

TEST(HairWorks, RotationWithinAQuarterInFloat_StaysWithinBound) {
  double worst = 0;
  for (int i = -200000; i <= 200000; ++i) {
    const float x = float(i * 0.5 * pi / 200000);
    const glm::vec2 turned = hairworks::rotation_within_quarter(x);
    worst = std::max(
        {worst, std::abs(double(turned.x) - std::cos(double(x))), std::abs(double(turned.y) - std::sin(double(x)))});
  }
  EXPECT_LT(worst, 2e-7);
}

}  // namespace
}  // namespace cuticle::bsdf::hairworks_test
