// The model's kernel on the device against double on the CPU.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/model_on_device.h"

namespace cuticle::bsdf::marschner_gpu_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct OnDevice {
  const Model& model = **find_model("marschner");
  GpuEvaluator& evaluator = tests::evaluator_of(model);
};
OnDevice& on_device() {
  static OnDevice instance;
  return instance;
}

struct Difference {
  double worst = 0, largest = 0;
};
Difference compare(std::string_view settings, Quantity quantity, int lobe, const std::vector<Point>& points) {
  OnDevice& on = on_device();
  const registry::ParameterValues values = *parse_settings(on.model, "", settings);
  std::vector<glm::dvec3> truth(points.size()), result(points.size());
  EXPECT_TRUE(evaluate(on.model, values, Precision::f64, {quantity, lobe, points}, truth).ok());
  EXPECT_TRUE(on.evaluator.evaluate(values, {quantity, lobe, points}, result).ok());
  Difference difference;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(result[i][c])) << settings << " point " << i;
      difference.worst = std::max(difference.worst, std::abs(truth[i][c] - result[i][c]));
      difference.largest = std::max(difference.largest, truth[i][c]);
    }
  return difference;
}

// eta' at 30 degrees is 1.694, its caustic at 9.24 degrees.
TEST(MarschnerGpu, AzimuthalTerm_AgreesWithDoubleAwayFromTheCaustic) {
  std::vector<Point> points;
  for (int i = -360; i <= 360; ++i)
    if (std::abs(std::abs(i * 0.5) - 9.2401) > 0.5) points.push_back({.theta_d = 30 * degree, .phi = i * 0.5 * degree});
  for (int lobe = 0; lobe < 3; ++lobe) {
    const Difference difference = compare("eta=1.55,sigma_a=0.2", Quantity::N, lobe, points);
    EXPECT_LE(difference.worst, 2e-6 * difference.largest) << lobe;
  }
}

// Not closer to the edge of h and theta_d, where narrowing the point itself to float changes F by more than the bound.
TEST(MarschnerGpu, ScatteringAndAttenuation_AgreeWithDouble) {
  std::vector<Point> points;
  for (int i = 0; i < 2000; ++i)
    points.push_back({.theta_i = std::sin(i * 1.1) * 1.57,
                      .theta_o = std::sin(i * 2.3) * 1.57,
                      .theta_d = std::sin(i * 0.7) * 1.5,
                      .phi = 0.6 + 2.5 * std::abs(std::sin(i * 0.9)),
                      .h = 0.99 * std::sin(i * 0.31)});
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::A}) {
    const Difference difference = compare("sigma_a=0.1/0.5/3", quantity, -1, points);
    EXPECT_LE(difference.worst, 2e-5 * difference.largest) << int(quantity);
  }
}

TEST(MarschnerGpu, Albedo_AgreesWithDouble) {
  const Difference difference =
      compare("", Quantity::albedo, 1, {{.theta_o = 0}, {.theta_o = 0.9}, {.theta_o = 1.5707}});
  EXPECT_LE(difference.worst, 2e-5 * difference.largest);
}

TEST(MarschnerGpu, EdgesOfTheDomain_AreFinite) {
  std::vector<Point> points;
  for (double theta_i : {-90.0, -89.999, 0.0, 90.0})
    for (double theta_o : {-90.0, 0.0, 89.999, 90.0})
      for (double theta_d : {0.0, 60.0, 89.999, 90.0})
        for (double phi : {0.0, 1e-7, 18.62, 120.0, 180.0, -180.0})
          for (double h : {-1.0, 0.0, 1.0})
            points.push_back({theta_i * degree, theta_o * degree, theta_d * degree, phi * degree, h});
  for (const char* settings : {"beta=0.001,sigma_a=0", "beta=1,sigma_a=100,eta=1.05", "eta=3", "eta=2"})
    for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A})
      compare(settings, quantity, -1, points);
}

TEST(MarschnerGpu, Variants_AgreeWithDouble) {
  std::vector<Point> points;
  for (int i = 0; i <= 150; ++i)
    if (i < 6 || i > 40) points.push_back({.theta_d = 20 * degree, .phi = i * 0.5 * degree, .phi_o = 0.4});
  for (const char* settings :
       {"variant=as_published", "caustic=smoothed", "variant=as_published,caustic=smoothed,eta=2.1"}) {
    const Difference difference = compare(settings, Quantity::N, 2, points);
    EXPECT_LE(difference.worst, 1e-5 * difference.largest) << settings;
  }
  const Difference smooth_ellipse = compare("aspect=0.85,caustic=smoothed", Quantity::N, 2, points);
  EXPECT_LE(smooth_ellipse.worst, 1e-4 * smooth_ellipse.largest);
  const Difference as_published = compare("variant=as_published", Quantity::M, 1, {{.theta_i = 0.1, .theta_o = 0.2}});
  EXPECT_LE(as_published.worst, 1e-5 * as_published.largest);
}

// The density where the device drew, against that of the same directions on the CPU.
TEST(MarschnerGpu, Sampler_DrawsWhatTheCpuDraws) {
  OnDevice& on = on_device();
  for (const char* settings : {"", "caustic=smoothed,aspect=0.9"}) {
    const registry::ParameterValues values = *parse_settings(on.model, "", settings);
    std::vector<SampleQuery> queries(500);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      queries[i].theta_o = std::sin(double(i)) * 1.5;
      for (std::size_t k = 0; k < 8; ++k) {
        const double turns = double(i + 1) * std::sqrt(double(2 + k * k + k));
        queries[i].u[k] = turns - std::floor(turns);
      }
    }
    std::vector<Sample> device(queries.size()), host(queries.size());
    ASSERT_TRUE(on.evaluator.sample(values, queries, device).ok());
    ASSERT_TRUE(sample(on.model, values, Precision::f32, queries, host).ok());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      EXPECT_EQ(device[i].lobe, host[i].lobe);
      EXPECT_NEAR(device[i].theta_i, host[i].theta_i, 1e-4);
      EXPECT_NEAR(std::cos(device[i].phi), std::cos(host[i].phi), 1e-4);
    }
  }
}

TEST(MarschnerGpu, SameBatchTwice_GivesTheSameBits) {
  OnDevice& on = on_device();
  const registry::ParameterValues values = registry::default_values(on.model.entry.parameters);
  const std::vector<Point> points = {{.theta_i = 0.1, .theta_o = 0.2, .phi = 0.3},
                                     {.theta_i = 0.4, .theta_o = -0.2, .phi = 3}};
  std::vector<glm::dvec3> first(2), second(2);
  ASSERT_TRUE(on.evaluator.evaluate(values, {Quantity::S, -1, points}, first).ok());
  ASSERT_TRUE(on.evaluator.evaluate(values, {Quantity::S, -1, points}, second).ok());
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace cuticle::bsdf::marschner_gpu_test
