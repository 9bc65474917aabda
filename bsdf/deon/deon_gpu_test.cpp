// The d'Eon model's kernel on the device against double on the CPU.
#include <cmath>

#include <gtest/gtest.h>

#include <cuticle/bsdf/model_gpu.h>

namespace cuticle::bsdf {
namespace {

/// A device and the model's kernel on it, made once.
struct OnDevice {
  std::shared_ptr<gpu::Device> device = *gpu::Device::open();
  const Model& model = **find_model("deon");
  GpuEvaluator evaluator = *GpuEvaluator::make(*device, model);
};
OnDevice& on_device() {
  static OnDevice instance;
  return instance;
}

/// The largest difference over the largest value.
double relative_difference(std::string_view settings, Quantity quantity, const std::vector<Point>& points) {
  OnDevice& on = on_device();
  const registry::ParameterValues values = *parse_settings(on.model, "", settings);
  std::vector<glm::dvec3> truth(points.size()), result(points.size());
  EXPECT_TRUE(evaluate(on.model, values, Precision::f64, {quantity, -1, points}, truth).ok());
  EXPECT_TRUE(on.evaluator.evaluate(values, {quantity, -1, points}, result).ok());
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(result[i][c])) << settings << " point " << i;
      worst = std::max(worst, std::abs(truth[i][c] - result[i][c]));
      largest = std::max(largest, truth[i][c]);
    }
  return worst / largest;
}

std::vector<Point> spread_points(double steepest) {
  std::vector<Point> points;
  for (int i = 0; i < 300; ++i)
    points.push_back({.theta_i = std::sin(i * 1.1) * steepest,
                      .theta_o = std::sin(i * 2.3) * steepest,
                      .theta_d = std::sin(i * 0.7) * steepest,
                      .phi = 3.14 * std::sin(i * 0.9),
                      .h = 0.99 * std::sin(i * 0.31)});
  return points;
}

TEST(DeonGpu, EveryQuantity_AgreesWithDouble) {
  for (const char* settings : {"azimuthal_tolerance=1e-5", "azimuthal_tolerance=1e-5,r_lobe=non_separable,beta_n=0.05"})
    for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::pdf, Quantity::albedo})
      EXPECT_LE(relative_difference(settings, quantity, spread_points(1.5)), 2e-5) << settings << " " << int(quantity);
}

TEST(DeonGpu, EdgesOfTheDomain_AreFinite) {
  for (const char* settings :
       {"beta_m=0.001,beta_n=0.001,sigma_a=0", "beta_m=1,beta_n=1,sigma_a=100,eta=1.05", "eta=3"})
    for (Quantity quantity : {Quantity::S, Quantity::N, Quantity::pdf, Quantity::error})
      relative_difference(settings, quantity,
                          {{1.5707963, -1.5707963, 1.5707963, 3.14159, 1}, {0, 1.5707963, 0, 0, -1}});
}

}  // namespace
}  // namespace cuticle::bsdf
