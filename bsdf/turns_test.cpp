// The mean over turns of a flat cross-section against the mean over the viewer's azimuth.
#include "bsdf/turns.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

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

/// Of huang, S by each of its lobes: R by one facet is a rule, all else are paths, each through a section of its own.
glm::dvec3 huang_at(const std::string& settings, int lobe, const Point& point) {
  glm::dvec3 out(0);
  EXPECT_TRUE(evaluate(**find_model("huang"), values_of("huang", settings), Precision::f64,
                       {Quantity::S, lobe, std::span(&point, 1)}, {&out, 1})
                  .ok());
  return out;
}
glm::dvec3 huang_over_viewers(const std::string& settings, int lobe, Point point, int count) {
  glm::dvec3 sum(0);
  for (int k = 0; k < count; ++k) {
    point.phi_o = 2 * pi * (k + 0.5) / count;
    sum += huang_at(settings, lobe, point) / double(count);
  }
  return sum;
}

TEST(MeanOverTurns, OfHuangsR_IsTheMeanOverTheViewersAzimuth) {
  const std::string single = "facets=single,aspect=0.6,roughness=0.2", near = single + ",field=near";
  for (double phi : {0.3, 2.0}) {
    const Point at{.theta_i = 0.2, .theta_o = -0.3, .phi = phi, .h = 0.4};
    for (const std::string& settings : {single, near}) {
      const double mean = huang_over_viewers(settings, 0, at, 24).x;
      EXPECT_NEAR(huang_at(settings + ",turns=12", 0, at).x, mean, 1e-4 * mean) << settings << " " << phi;
    }
  }
}

/// One viewer at an azimuth, lights evenly over the sphere.
std::vector<Point> lights_around(double phi_o) {
  std::vector<Point> points;
  for (int i = 0; i < 96; ++i)
    points.push_back({.theta_i = std::asin((i + 0.5) / 48 - 1),
                      .theta_o = -0.3,
                      .phi = std::remainder(i * 2.399963229728653, 2 * pi),
                      .phi_o = phi_o});
  return points;
}
using Values = std::vector<glm::dvec3>;
Values of_viewer(const std::string& settings, double phi_o) {
  const std::vector<Point> points = lights_around(phi_o);
  Values out(points.size());
  EXPECT_TRUE(*scattering_from_viewers(**find_model("huang"), values_of("huang", settings), 1, -1, points, out));
  return out;
}
Values one_by_one(const std::string& settings) {
  const std::vector<Point> points = lights_around(0);
  Values out(points.size());
  EXPECT_TRUE(
      evaluate(**find_model("huang"), values_of("huang", settings), Precision::f64, {Quantity::S, -1, points}, out)
          .ok());
  return out;
}

/// Root mean square and mean of what is left, relative.
void expect_alike(const Values& made, const Values& truth, double rms, double mean) {
  double squares = 0, signal = 0, sum = 0, whole = 0;
  for (std::size_t i = 0; i < made.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      squares += std::pow(made[i][c] - truth[i][c], 2);
      signal += std::pow(truth[i][c], 2);
      sum += made[i][c] - truth[i][c];
      whole += truth[i][c];
    }
  std::printf("rms %.4f, mean %.4f\n", std::sqrt(squares / signal), sum / whole);
  EXPECT_LT(std::sqrt(squares / signal), rms);
  EXPECT_LT(std::abs(sum / whole), mean);
}

TEST(MeanOverTurns, OfHuang_IsTheMeanOverTheViewersAzimuth) {
  const std::string flat = "sigma_a=0.1/0.3/0.8,aspect=0.6,roughness=0.3,samples=";
  Values mean(lights_around(0).size(), glm::dvec3(0));
  for (int k = 0; k < 24; ++k) {
    const Values turned = of_viewer(flat + "1024", 2 * pi * (k + 0.5) / 24);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += turned[i] / 24.0;
  }
  const Values made = of_viewer(flat + "16384,turns=12", 0);
  expect_alike(made, mean, 0.03, 0.008);
  expect_alike(one_by_one(flat + "4096,turns=12"), made, 0.04, 0.01);
  expect_alike(of_viewer(flat + "16384,turns=12", 1.3), made, 1e-12, 1e-12);
}

TEST(MeanOverTurns, KnowsNoViewersAzimuthAndIsEvenInPhi) {
  const double one = value_at("aspect=0.85,turns=16", Quantity::N, {.phi = 0.2});
  EXPECT_EQ(one, value_at("aspect=0.85,turns=16", Quantity::N, {.phi = -0.2, .phi_o = 1}));
  EXPECT_EQ(value_at("aspect=1,turns=16", Quantity::N, {.phi = 0.2}), value_at("", Quantity::N, {.phi = 0.2}));
}

}  // namespace
}  // namespace cuticle::bsdf::turns_test
