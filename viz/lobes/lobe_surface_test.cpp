// The numbers behind a view of lobes.
#include <cmath>
#include <numbers>

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
  EXPECT_NEAR(radius * peak, value, 3e-3 * peak) << "the mean over six degrees of phi";
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

/// Integral of S over the sphere of outgoing (or incoming) directions, the other one fixed, with the cosine that makes
/// it energy: two-point Gauss in parts of the inclination, even steps in phi.
double integral_of(const ShownModel& shown, double fixed, bool over_outgoing) {
  constexpr int parts = 100, columns = 180;
  const double node = 1 / std::sqrt(3.0);
  std::vector<bsdf::Point> points;
  std::vector<double> weights;
  for (int part = 0; part < 2 * parts; ++part)
    for (int column = 0; column < columns; ++column) {
      const double place = (part / 2 + 0.5 + (part % 2 ? node : -node) / 2) / parts;
      const double theta = (place - 0.5) * std::numbers::pi,
                   phi = (2 * (column + 0.5) / columns - 1) * std::numbers::pi;
      points.push_back(
          {.theta_i = over_outgoing ? fixed : theta, .theta_o = over_outgoing ? theta : fixed, .phi = phi});
      weights.push_back(std::cos(theta) * std::numbers::pi * std::numbers::pi / (parts * columns));
    }
  std::vector<glm::dvec3> values(points.size());
  EXPECT_TRUE(
      bsdf::evaluate(*shown.model, shown.values, bsdf::Precision::f64, {bsdf::Quantity::S, -1, points}, values).ok());
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weights[i] * mean(values[i]);
  return sum;
}

/// A surface shows where one light's energy goes: over outgoing directions. The albedo is the energy that one viewer
/// receives: over incoming ones. They are equal where light and eye may be exchanged. Attenuation of chiang follows
/// theta_o alone, so that its two differ.
TEST(Scattered, OfAModelWithoutReciprocity_IsItsOwnIntegralAndTheAlbedoTheOther) {
  const ShownModel shown = shown_model("chiang", "alpha=0");
  const double outgoing = integral_of(shown, 0.5, true), incoming = integral_of(shown, 0.5, false);
  const LobeValues values = lobe_values(shown, {0.5}, {91, 181}, true).value();
  EXPECT_NEAR(scattered(values.grid, values.sum()), outgoing, 2e-4);
  EXPECT_NEAR(value_of(shown, bsdf::Quantity::albedo, -1, {.theta_o = 0.5}), incoming, 2e-4);
  EXPECT_GT(std::abs(outgoing - incoming), 5e-3);
}

/// Without tilt, S of marschner is the same with light and eye exchanged, so that what leaves is the albedo of what
/// comes in.
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
