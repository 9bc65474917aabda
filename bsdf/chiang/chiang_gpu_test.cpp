// The Chiang kernel on the device against double on the CPU, near and far field, and the edges of the domain.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/support/model_on_device.h"

namespace cuticle::bsdf::chiang_gpu_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct OnDevice {
  const Model& model = **find_model("chiang");
  GpuEvaluator& evaluator = tests::evaluator_of(model);
};
OnDevice& on_device() {
  static OnDevice instance;
  return instance;
}

/// The largest difference from double, relative to the larger of the value and `floor` of the batch's largest.
double worst_difference(std::string_view settings, Quantity quantity, const std::vector<Point>& points, double floor) {
  OnDevice& on = on_device();
  const registry::ParameterValues values = *parse_settings(on.model, "", settings);
  std::vector<glm::dvec3> truth(points.size()), result(points.size());
  EXPECT_TRUE(evaluate(on.model, values, Precision::f64, {quantity, -1, points}, truth).ok());
  EXPECT_TRUE(on.evaluator.evaluate(values, {quantity, -1, points}, result).ok());
  double largest = 0, worst = 0;
  for (const glm::dvec3& value : truth) largest = std::max({largest, value.x, value.y, value.z});
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(result[i][c])) << settings << " point " << i;
      worst = std::max(worst, std::abs(truth[i][c] - result[i][c]) / std::max(truth[i][c], floor * largest));
    }
  return worst;
}

std::vector<Point> spread_points(int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
    points.push_back({.theta_i = std::sin(i * 1.1) * 1.5,
                      .theta_o = std::sin(i * 2.3) * 1.5,
                      .theta_d = std::sin(i * 0.7) * 1.5,
                      .phi = 3.1 * std::sin(i * 0.9),
                      .h = 0.99 * std::sin(i * 0.31)});
  return points;
}

TEST(ChiangGpu, NearField_AgreesWithDouble) {
  for (Quantity quantity : {Quantity::S, Quantity::pdf, Quantity::M, Quantity::N, Quantity::A, Quantity::albedo})
    EXPECT_LE(worst_difference("field=near,sigma_a=0.1/0.5/3", quantity, spread_points(2000), 1e-6), 3e-5)
        << int(quantity);
}

TEST(ChiangGpu, FarField_AgreesWithDoubleWithinItsTolerance) {
  for (Quantity quantity : {Quantity::S, Quantity::pdf, Quantity::albedo})
    EXPECT_LE(worst_difference("sigma_a=0.1/0.5/3,tolerance=1e-4", quantity, spread_points(60), 1e-6), 4e-4)
        << int(quantity);
}

// A random number at the border of two lobes may fall on either side.
TEST(ChiangGpu, Samples_AreThoseOfTheCpu) {
  OnDevice& on = on_device();
  RandomStream random(3);
  std::vector<SampleQuery> queries(1000);
  for (SampleQuery& query : queries) {
    query = {.theta_o = 3 * random.next_unit() - 1.5, .h = 1.98 * random.next_unit() - 0.99};
    for (double& u : query.u) u = random.next_unit();
  }
  std::vector<Sample> truth(1000), result(1000);
  const registry::ParameterValues values = *parse_settings(on.model, "", "field=near,beta_m=0.4,beta_n=0.4");
  ASSERT_TRUE(sample(on.model, values, Precision::f64, queries, truth).ok());
  ASSERT_TRUE(on.evaluator.sample(values, queries, result).ok());
  int apart = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (std::abs(result[i].theta_i - truth[i].theta_i) > 1e-4 ||
        std::abs(std::remainder(result[i].phi - truth[i].phi, 360 * degree)) > 1e-4 ||
        std::abs(result[i].weight.x - truth[i].weight.x) > 1e-3)
      ++apart;
  EXPECT_LE(apart, 2);
}

TEST(ChiangGpu, EdgesOfTheDomain_AreFinite) {
  std::vector<Point> points;
  for (double theta_i : {-90.0, -89.999, 0.0, 90.0})
    for (double theta_o : {-90.0, 0.0, 89.999, 90.0})
      for (double phi : {0.0, 1e-7, 120.0, 180.0, -180.0})
        for (double h : {-1.0, 0.0, 1.0}) points.push_back({theta_i * degree, theta_o * degree, 0, phi * degree, h});
  for (const char* settings :
       {"beta_m=0.001,beta_n=0.001,sigma_a=0", "beta_m=1,beta_n=1,sigma_a=100,eta=1.05", "eta=3,alpha=0.17"})
    for (Quantity quantity : {Quantity::S, Quantity::pdf, Quantity::N, Quantity::A})
      worst_difference(std::string("field=near,") + settings, quantity, points, 1);
}

}  // namespace
}  // namespace cuticle::bsdf::chiang_gpu_test
