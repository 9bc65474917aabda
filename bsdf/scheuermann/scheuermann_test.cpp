// The features of Scheuermann's shader, by vectors of its own. Labels: A4 A5 A6.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bsdf/scheuermann/shading.h"
#include "tests/support/model_values.h"

namespace cuticle::bsdf::scheuermann_test {
namespace {

constexpr double pi = std::numbers::pi;

double value(const std::string& settings, std::string_view lobe, const Point& point, Quantity quantity = Quantity::S) {
  return tests::model_value("scheuermann", settings, quantity, lobe, point).x;
}
glm::dvec3 direction(double theta, double phi) {
  return {std::sin(theta), std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi)};
}

// A4
TEST(Scheuermann, Highlight_IsThePowerOfTheSineBetweenTangentAndHalfVector) {
  for (double theta_i : {0.1, 0.6, 1.2}) {
    const glm::dvec3 half = glm::normalize(direction(theta_i, -1.0) + direction(0.2, 0));
    EXPECT_NEAR(value("primary=1,primary_exponent=20,primary_shift=0", "primary",
                      {.theta_i = theta_i, .theta_o = 0.2, .phi = 1}),
                std::pow(std::sqrt(1 - half.x * half.x), 20), 1e-14);
  }
}

// A4: the half vector may point against the tangent, and there the highlight fades.
TEST(Scheuermann, DirectionalAttenuation_FadesTheHighlightAgainstTheTangentOnly) {
  for (double theta : {0.2, 0.7, 1.3}) {
    const auto at = [&](double t) {
      return value("primary=1,primary_exponent=1,primary_shift=0", "primary", {.theta_i = t, .theta_o = t});
    };
    const double t = 1 - std::sin(theta), fade = t * t * (3 - 2 * t);
    EXPECT_NEAR(at(theta), std::cos(theta), 1e-14);
    EXPECT_NEAR(at(-theta), std::cos(theta) * fade, 1e-14);
  }
}

/// Which of the points has the largest value.
std::size_t brightest(const std::string& settings, std::string_view lobe, const std::vector<Point>& points) {
  const auto values = tests::model_values("scheuermann", settings, Quantity::S, lobe, points);
  const auto largest = std::max_element(values.begin(), values.end(), [](auto a, auto b) { return a.x < b.x; });
  return std::size_t(largest - values.begin());
}

/// The inclination of light at which a lobe peaks for a viewer at normal incidence, by a fine scan.
double peak(const std::string& settings, std::string_view lobe) {
  std::vector<Point> points;
  for (double theta_i = -1; theta_i < 1; theta_i += 1e-4) points.push_back({.theta_i = theta_i});
  return points[brightest(settings, lobe, points)].theta_i;
}

// A5
TEST(Scheuermann, PositiveShift_ReflectsTowardTheRootAndNegativeTowardTheTip) {
  for (double shift : {0.2, -0.2, 0.05}) {
    const std::string settings = fmt::format("primary_exponent=2000,primary_shift={}", shift);
    EXPECT_NEAR(peak(settings, "primary"), -2 * std::atan(shift), 2e-3);
  }
}

/// Where along a strand that runs over a round head, from the crown (0) downwards [rad], a lobe is brightest; light and
/// viewer stand together at the inclination `above` from the crown.
double highlight_on_head(const std::string& settings, std::string_view lobe, double above) {
  std::vector<Point> points;
  for (double place = 0; place < pi / 2; place += 1e-3)  // both against the strand, whose normal stands at `place`
    points.push_back({.theta_i = above - place, .theta_o = above - place});
  return above - points[brightest(settings, lobe, points)].theta_i;
}

// A5: what is reflected toward the root is seen nearer to the tip.
TEST(Scheuermann, OnARoundHead_ThePrimaryMovesToTheTipAndTheSecondaryToTheRoot) {
  const std::string narrow = "primary_exponent=2000,secondary_exponent=2000";
  EXPECT_NEAR(highlight_on_head(narrow + ",primary_shift=0", "primary", 0.8), 0.8, 2e-3);
  EXPECT_NEAR(highlight_on_head(narrow, "primary", 0.8), 0.8 + std::atan(0.05), 2e-3);
  EXPECT_NEAR(highlight_on_head(narrow, "secondary", 0.8), 0.8 - std::atan(0.08), 2e-3);
}

// A5
TEST(Scheuermann, ShiftTexture_AddsItselfMinusOneHalfToBothShifts) {
  const Point point{.theta_i = 0.3, .theta_o = 0.1, .phi = 0.4};
  EXPECT_NEAR(value("primary_shift=0.1,shift_texture=0.7", "primary", point),
              value("primary_shift=0.3", "primary", point), 1e-15);
  EXPECT_NEAR(value("secondary_shift=0.1,shift_texture=0.2", "secondary", point),
              value("secondary_shift=-0.2", "secondary", point), 1e-15);
}

// A5
TEST(Scheuermann, Highlights_HaveTheirOwnColourAndExponent) {
  const Point point{.theta_i = 0.4, .theta_o = 0.1};
  const std::string settings =
      "primary=0.1/0.2/0.3,secondary=0.6/0.4/0.2,primary_exponent=8,secondary_exponent=16,"
      "primary_shift=0,secondary_shift=0";
  const glm::dvec3 first = tests::model_value("scheuermann", settings, Quantity::S, "primary", point);
  const glm::dvec3 second = tests::model_value("scheuermann", settings, Quantity::S, "secondary", point);
  EXPECT_NEAR(first.z / first.x, 3, 1e-14);
  EXPECT_NEAR(second.x / second.z, 3, 1e-14);
  EXPECT_NEAR(second.x / 0.6, std::pow(first.x / 0.1, 2), 1e-14);
}

// A5
TEST(Scheuermann, Mask_DimsTheSecondaryHighlightOnly) {
  const Point point{.theta_i = 0.1, .theta_o = 0.1};
  EXPECT_DOUBLE_EQ(value("mask=0.25", "secondary", point), 0.25 * value("", "secondary", point));
  EXPECT_EQ(value("mask=0", "secondary", point), 0);
  EXPECT_EQ(value("mask=0", "primary", point), value("", "primary", point));
}

// A6
TEST(Scheuermann, Diffuse_IsALerpOfTheNormalThatFacesTheViewer) {
  for (double theta_i : {0.0, 0.7})
    for (double phi : {0.0, 1.0, 1.7, 2.5, pi}) {
      const double cos_normal = std::cos(theta_i) * std::cos(phi);
      EXPECT_NEAR(value("diffuse=1", "diffuse", {.theta_i = theta_i, .theta_o = 0.4, .phi = phi}),
                  std::clamp(0.25 + 0.75 * cos_normal, 0.0, 1.0), 1e-15);
    }
}

// A6
TEST(Scheuermann, FinalColour_IsTheSumTimesBaseLightAndOcclusionWithTheTexturesAlpha) {
  const Model& model = **find_model("scheuermann");
  const registry::ParameterValues values = *parse_settings(model, "", "diffuse=0.3/0.2/0.1,secondary=0.2");
  const scheuermann::HairTexel texel{{0.5, 0.25, 1}, 0.375, 0.6, 0.7, 0.8};
  const Point point{.theta_i = 0.2, .theta_o = 0.1, .phi = 0.5};
  const glm::dvec4 color = *scheuermann::shaded_texel(values, texel, {2, 3, 4}, point);
  const std::string alone = "diffuse=0.3/0.2/0.1,secondary=0.2,shift_texture=0.6,mask=0.7";
  const glm::dvec3 sum = tests::model_value("scheuermann", alone, Quantity::S, "diffuse", point) +
                         tests::model_value("scheuermann", alone, Quantity::S, "primary", point) +
                         tests::model_value("scheuermann", alone, Quantity::S, "secondary", point);
  const glm::dvec3 expected = sum * texel.base * glm::dvec3(2, 3, 4) * 0.8;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], expected[c], 1e-15);
  EXPECT_EQ(color.w, 0.375);
}

TEST(Scheuermann, DiffuseAlbedo_IsItsClosedForm) {
  EXPECT_DOUBLE_EQ(value("diffuse=1", "diffuse", {.theta_o = 1}, Quantity::albedo), 4 * pi / 3);
}

TEST(Scheuermann, OppositeDirections_HaveAFullHighlight) {
  EXPECT_NEAR(value("primary=1", "primary", {.theta_i = -0.4, .theta_o = 0.4, .phi = pi}), 1, 0.6);
}

TEST(Scheuermann, BadParameters_AreRefusedByName) {
  const Model& model = **find_model("scheuermann");
  for (const char* settings : {"mask=1.5", "shift_texture=-0.1", "primary_shift=2", "occlusion=nan"}) {
    const auto values = parse_settings(model, "", settings);
    ASSERT_FALSE(values.ok()) << settings;
    EXPECT_THAT(values.error().message, testing::HasSubstr(std::string(settings).substr(0, 4)));
  }
}

}  // namespace
}  // namespace cuticle::bsdf::scheuermann_test
