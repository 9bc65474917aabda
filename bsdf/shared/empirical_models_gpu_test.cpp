// The kernels of Kajiya-Kay, Scheuermann and HairWorks on the device against double on the CPU.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/model_on_device.h"

namespace cuticle::bsdf::empirical_models_gpu_test {
namespace {

class EmpiricalModelsGpu : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, EmpiricalModelsGpu, testing::Values("kajiya_kay", "scheuermann", "hairworks"));

/// The largest difference over the largest value.
double difference(GpuEvaluator& evaluator, const Model& model, Quantity quantity, int lobe,
                  const std::vector<Point>& points) {
  const registry::ParameterValues values = registry::default_values(model.entry.parameters);
  std::vector<glm::dvec3> truth(points.size()), result(points.size());
  EXPECT_TRUE(evaluate(model, values, Precision::f64, {quantity, lobe, points}, truth).ok());
  EXPECT_TRUE(evaluator.evaluate(values, {quantity, lobe, points}, result).ok());
  double worst = 0, largest = 1e-30;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(std::isfinite(result[i].x)) << i;
    worst = std::max(worst, std::abs(truth[i].x - result[i].x));
    largest = std::max(largest, truth[i].x);
  }
  return worst / largest;
}

TEST_P(EmpiricalModelsGpu, EveryQuantityAndLobe_AgreesWithDouble) {
  const Model& model = **find_model(GetParam());
  GpuEvaluator& evaluator = tests::evaluator_of(model);
  std::vector<Point> points;
  for (int i = 0; i < 1000; ++i)
    points.push_back({.theta_i = std::sin(i * 1.1) * 1.57,
                      .theta_o = std::sin(i * 2.3) * 1.57,
                      .theta_d = std::sin(i * 0.7) * 1.5,
                      .phi = std::sin(i * 0.9) * 3.1});
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::pdf, Quantity::error})
    for (int lobe = -1; lobe < int(model.lobes.size()); ++lobe)
      EXPECT_LE(difference(evaluator, model, quantity, lobe, points), 4e-6) << int(quantity) << " " << lobe;
  EXPECT_LE(difference(evaluator, model, Quantity::albedo, -1, {{.theta_o = 0}, {.theta_o = 1.2}, {.theta_o = -1.5}}),
            1e-5);
}

TEST_P(EmpiricalModelsGpu, EdgesOfTheDomain_AreFinite) {
  const Model& model = **find_model(GetParam());
  GpuEvaluator& evaluator = tests::evaluator_of(model);
  std::vector<Point> points;
  constexpr double right = std::numbers::pi / 2;
  for (double theta_i : {-right, 0.0, right})
    for (double theta_o : {-right, 0.0, right})
      for (double phi : {0.0, 1e-7, 2 * right, -2 * right}) points.push_back({theta_i, theta_o, theta_i, phi, 1});
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::pdf, Quantity::albedo})
    difference(evaluator, model, quantity, -1, points);
}

}  // namespace
}  // namespace cuticle::bsdf::empirical_models_gpu_test
