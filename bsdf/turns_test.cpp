// The mean over turns of a flat cross-section against the mean over the viewer's azimuth.
#include "bsdf/turns.h"

#include <numbers>

#include <gtest/gtest.h>

namespace cuticle::bsdf::turns_test {
namespace {

constexpr double pi = std::numbers::pi;

registry::ParameterValues values_of(std::string_view model, std::string_view settings) {
  return parse_settings(**find_model(model), "", settings).value();
}
double value_at(const std::string& settings, Quantity quantity, const Point& point) {
  glm::dvec3 out(0);
  const Request request{quantity, 2, std::span(&point, 1)};
  EXPECT_TRUE(
      evaluate(**find_model("marschner"), values_of("marschner", settings), Precision::f64, request, {&out, 1}).ok());
  return out.x;
}
double mean_over_viewers(const std::string& settings, Quantity quantity, Point point, int count) {
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    point.phi_o = 2 * pi * (k + 0.5) / count;
    sum += value_at(settings, quantity, point) / count;
  }
  return sum;
}

TEST(OverTurns, OnlyFlatFibresWithoutAMeanOfTheirOwn_Change) {
  EXPECT_EQ(over_turns(values_of("marschner", "aspect=0.9"), 16), values_of("marschner", "aspect=0.9,turns=16"));
  for (const char* settings : {"", "aspect=1", "aspect=0.9,turns=5"})
    EXPECT_EQ(over_turns(values_of("marschner", settings), 16), values_of("marschner", settings)) << settings;
  EXPECT_EQ(over_turns(values_of("kajiya_kay", ""), 16), values_of("kajiya_kay", ""));
  EXPECT_EQ(over_turns(values_of("huang", "aspect=0.9"), 16), values_of("huang", "aspect=0.9,turns=16"));
  EXPECT_FALSE(is_turned_by_viewer(values_of("huang", "aspect=0.9,turns=16")));
}

TEST(MeanOverTurns, OfNWithoutItsCaustic_IsTheMeanOverTheViewersAzimuth) {
  for (const char* variant : {"corrected", "as_published"})
    for (double aspect : {0.85, 0.95, 1.1})
      for (double phi : {-0.7, 0.0, 0.3, 2.0}) {
        const std::string settings = "caustic=smoothed,aspect=" + std::to_string(aspect) + ",variant=" + variant;
        const Point at{.theta_d = 0.4, .phi = phi};
        const double mean = mean_over_viewers(settings, Quantity::N, at, 720);
        EXPECT_NEAR(value_at(settings + ",turns=360", Quantity::N, at), mean, 1e-3 * mean) << settings << " " << phi;
      }
}

TEST(MeanOverTurns, OfTheAlbedo_IsTheMeanOverTheViewersAzimuth) {
  for (const char* aspect : {"0.85", "0.95"}) {
    const std::string settings = std::string("beta=0.05,alpha=0,aspect=") + aspect;
    const double mean = mean_over_viewers(settings, Quantity::albedo, {.theta_o = 0.3}, 24);
    EXPECT_NEAR(value_at(settings + ",turns=128", Quantity::albedo, {.theta_o = 0.3}), mean, 0.01 * mean) << aspect;
  }
}

TEST(MeanOverTurns, KnowsNoViewersAzimuthAndIsEvenInPhi) {
  const double one = value_at("aspect=0.85,turns=16", Quantity::N, {.phi = 0.2});
  EXPECT_EQ(one, value_at("aspect=0.85,turns=16", Quantity::N, {.phi = -0.2, .phi_o = 1}));
  EXPECT_EQ(value_at("aspect=1,turns=16", Quantity::N, {.phi = 0.2}), value_at("", Quantity::N, {.phi = 0.2}));
}

}  // namespace
}  // namespace cuticle::bsdf::turns_test
