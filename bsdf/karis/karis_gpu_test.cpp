// The model's kernels on the device against double on the CPU.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/model_on_device.h"

namespace cuticle::bsdf::karis_gpu_test {
namespace {

struct OnDevice {
  const Model& model = **find_model("karis");
  GpuEvaluator& evaluator = tests::evaluator_of(model);
};
OnDevice& on_device() {
  static OnDevice instance;
  return instance;
}

TEST(KarisGpu, EveryQuantity_AgreesWithDouble) {
  OnDevice& on = on_device();
  const registry::ParameterValues values = *parse_settings(on.model, "", "color=0.1/0.5/0.9");
  std::vector<Point> points = {{},
                               {.theta_i = std::numbers::pi / 2, .theta_o = -std::numbers::pi / 2, .phi = 3, .h = 1}};
  for (int i = 0; i < 300; ++i)
    points.push_back({std::sin(i * 1.1) * 1.5, std::sin(i * 2.3) * 1.5, std::sin(i * 0.7) * 1.5,
                      std::sin(i * 0.9) * 3.1, 0.99 * std::sin(i * 0.31), 0});
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::pdf, Quantity::error}) {
    std::vector<glm::dvec3> truth(points.size()), device(points.size());
    ASSERT_TRUE(evaluate(on.model, values, Precision::f64, {quantity, -1, points}, truth).ok());
    ASSERT_TRUE(on.evaluator.evaluate(values, {quantity, -1, points}, device).ok());
    double largest = 0, worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        largest = std::max(largest, truth[i][c]);
        worst = std::max(worst, std::abs(truth[i][c] - device[i][c]));
      }
    EXPECT_LE(worst, 1e-5 * largest) << int(quantity);
  }
}

TEST(KarisGpu, Sampler_DrawsWhatTheCpuDraws) {
  OnDevice& on = on_device();
  const registry::ParameterValues values = registry::default_values(on.model.entry.parameters);
  std::vector<SampleQuery> queries(300);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    queries[i].theta_o = std::sin(double(i)) * 1.5;
    for (std::size_t k = 0; k < 3; ++k)
      queries[i].u[k] = std::fmod(double(i + 1) * std::sqrt(double(2 + k * k + k)), 1.0);
  }
  std::vector<Sample> device(queries.size()), host(queries.size());
  ASSERT_TRUE(on.evaluator.sample(values, queries, device).ok());
  ASSERT_TRUE(sample(on.model, values, Precision::f32, queries, host).ok());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    EXPECT_EQ(device[i].lobe, host[i].lobe);
    EXPECT_NEAR(std::sin(device[i].theta_i), std::sin(host[i].theta_i), 1e-6);  // along the fibre one rounding is 3e-4 of angle
    EXPECT_NEAR(std::cos(device[i].phi), std::cos(host[i].phi), 1e-4);
  }
}

}  // namespace
}  // namespace cuticle::bsdf::karis_gpu_test
