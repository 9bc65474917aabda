// The numbers behind a view of lobes.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "viz/color/ramp.h"
#include "viz/lobes/numbers.h"
#include "viz/lobes/surface.h"

namespace cuticle::viz::lobe_surface_test {
namespace {

ShownModel shown_model(const char* name, const char* settings = "") {
  const bsdf::Model* model = bsdf::find_model(name).value();
  return {model, bsdf::parse_settings(*model, "", settings).value()};
}

double value_of(const ShownModel& shown, bsdf::Quantity quantity, int lobe, const bsdf::Point& point) {
  glm::dvec3 value;
  EXPECT_TRUE(bsdf::evaluate(*shown.model, shown.values, bsdf::Precision::f64, {quantity, lobe, std::span(&point, 1)},
                             std::span(&value, 1))
                  .ok());
  return mean(value);
}

TEST(SurfaceRadius, Decades_AreEvenSteps) {
  EXPECT_DOUBLE_EQ(surface_radius(10, 10, true), 1);
  EXPECT_DOUBLE_EQ(surface_radius(1, 10, true), 2.0 / 3);
  EXPECT_DOUBLE_EQ(surface_radius(1e-9, 10, true), 0);
  EXPECT_DOUBLE_EQ(surface_radius(0, 10, true), 0);
  EXPECT_DOUBLE_EQ(surface_radius(1e9, 10, true), 1);
}

TEST(SurfaceRadius, Linear_IsTheShareOfThePeak) { EXPECT_DOUBLE_EQ(surface_radius(2.5, 10, false), 0.25); }

TEST(MakeSurfaces, SingleLobe_ReachesAsFarAsTheModelSays) {
  const ShownModel shown = shown_model("marschner");
  const LobeSettings settings{0.5, "TT", false};
  const LobeValues values = lobe_values(shown, settings, {61, 361}, true).value();
  const double peak = peak_of(values, "TT");
  const auto surfaces = make_surfaces(values, settings, peak).value();
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0].name, "TT");
  const int row = 24, column = 350;
  const bsdf::Point point{.theta_i = 0.5, .theta_o = values.grid.theta_o(row), .phi = values.grid.phi(column)};
  const double value = value_of(shown, bsdf::Quantity::S, 1, point);
  const glm::dvec3 position = surfaces[0].positions[std::size_t(row) * 361 + column];
  const double radius = std::sqrt(position.x * position.x + position.y * position.y + position.z * position.z);
  EXPECT_NEAR(radius * peak, value, 2e-3 * peak) << "the mean over four degrees of phi";
  EXPECT_NEAR(std::atan2(position.y, position.x), point.phi, 1e-9);
  EXPECT_NEAR(std::asin(position.z / radius), point.theta_o, 1e-9);
}

TEST(MakeSurfaces, AllLobes_AreOneSurfaceEachInItsColour) {
  const LobeValues values = lobe_values(shown_model("marschner"), {0.5}, k_moving_grid, false).value();
  const auto surfaces = make_surfaces(values, {0.5}, 1).value();
  ASSERT_EQ(surfaces.size(), 3u);
  const char* const names[] = {"R", "TT", "TRT"};
  for (std::size_t lobe = 0; lobe < 3; ++lobe) EXPECT_EQ(surfaces[lobe].colors.front(), lobe_color(names[lobe]));
}

TEST(MakeSurfaces, UnknownLobe_IsRefusedByName) {
  const LobeValues values = lobe_values(shown_model("marschner"), {0.5}, k_moving_grid, false).value();
  const auto surfaces = make_surfaces(values, {0.5, "TTT"}, 1);
  ASSERT_FALSE(surfaces.ok());
  EXPECT_THAT(surfaces.error().message, testing::HasSubstr("R, TT, TRT"));
}

/// Without tilt, S of marschner is the same with light and eye exchanged, so that what leaves is the albedo of what comes
/// in. (Of chiang, whose attenuation follows theta_o alone, the two differ by .009 at theta_i = .5.)
void expect_albedo(const char* model, const char* settings, double theta_i, double bound) {
  const ShownModel shown = shown_model(model, settings);
  const LobeValues values = lobe_values(shown, {theta_i}, {91, 181}, true).value();
  const double albedo = value_of(shown, bsdf::Quantity::albedo, -1, {.theta_o = theta_i});
  EXPECT_NEAR(scattered(values.grid, values.sum()), albedo, bound) << model << " at " << theta_i;
}

TEST(Scattered, OfAnUntiltedFibre_IsTheAlbedo) {
  for (const double theta_i : {0.0, 0.5, 0.9}) expect_albedo("marschner", "alpha=0", theta_i, 2e-3);
}

TEST(DifferenceSurface, ModelWithItself_IsTheMiddleColour) {
  const LobeValues values = lobe_values(shown_model("marschner"), {0.5}, k_moving_grid, false).value();
  const LobeSurface surface = difference_surface(values, values, {0.5}, 1);
  EXPECT_EQ(surface.colors[1234], ramp_color(Ramp::diverging, 0.5));
}

}  // namespace
}  // namespace cuticle::viz::lobe_surface_test
