// The microfacet model's kernel on the device against double on the CPU.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/model_on_device.h"

namespace cuticle::bsdf::huang_gpu_test {
namespace {

struct OnDevice {
  const Model& model = **find_model("huang");
  GpuEvaluator& evaluator = tests::evaluator_of(model);
};
OnDevice& on_device() {
  static OnDevice instance;
  return instance;
}

std::vector<glm::dvec3> on_gpu(std::string_view settings, Quantity quantity, int lobe,
                               const std::vector<Point>& points) {
  OnDevice& on = on_device();
  std::vector<glm::dvec3> result(points.size());
  EXPECT_TRUE(on.evaluator.evaluate(*parse_settings(on.model, "", settings), {quantity, lobe, points}, result).ok());
  return result;
}
std::vector<glm::dvec3> on_cpu(std::string_view settings, Quantity quantity, int lobe,
                               const std::vector<Point>& points) {
  std::vector<glm::dvec3> result(points.size());
  const Model& model = on_device().model;
  EXPECT_TRUE(
      evaluate(model, *parse_settings(model, "", settings), Precision::f64, {quantity, lobe, points}, result).ok());
  return result;
}

std::vector<Point> spread_points(int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
    points.push_back({.theta_i = std::sin(i * 1.1) * 1.3,
                      .theta_o = std::sin(i * 2.3) * 1.3,
                      .theta_d = std::sin(i * 0.7),
                      .phi = 3.14 * std::sin(i * 0.9),
                      .h = 0.95 * std::sin(i * 0.31),
                      .phi_o = 3 * std::sin(i * 0.5)});
  return points;
}

TEST(HuangGpu, Scattering_AgreesWithDoubleWithinItsError) {
  const std::vector<Point> points = spread_points(128);
  for (const char* settings : {"roughness=0.4,samples=64", "roughness=0.2,samples=64,aspect=0.6,field=near",
                               "roughness=0.4,samples=64,aspect=0.6,turns=6"})
    for (int lobe = 0; lobe < 3; ++lobe) {
      const auto truth = on_cpu(settings, Quantity::S, lobe, points),
                 error = on_cpu(settings, Quantity::error, lobe, points);
      const auto result = on_gpu(settings, Quantity::S, lobe, points);
      for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(result[i].x, truth[i].x, error[i].x + 2e-4 * truth[i].x + 1e-6) << settings << lobe << " " << i;
    }
}

TEST(HuangGpu, Density_AgreesWithDouble) {
  const std::vector<Point> points = spread_points(128);
  const auto truth = on_cpu("", Quantity::pdf, -1, points), result = on_gpu("", Quantity::pdf, -1, points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(result[i].x, truth[i].x, 1e-3 * truth[i].x) << i;
}

TEST(HuangGpu, EdgesOfTheDomain_AreFinite) {
  std::vector<Point> points;
  for (double theta_i : {-1.5707963267948966, 0.0, 1.5707})
    for (double theta_o : {-1.5707963267948966, 0.0, 1.5707963267948966})
      for (double phi : {0.0, 3.141592653589793})
        for (double h : {-1.0, 1.0}) points.push_back({theta_i, theta_o, theta_o, phi, h, 0.3});
  for (const char* settings : {"roughness=0.001,sigma_a=0,samples=64", "roughness=1,sigma_a=100,aspect=0.2,samples=64"})
    for (Quantity quantity : {Quantity::S, Quantity::pdf})
      for (const glm::dvec3& value : on_gpu(settings, quantity, -1, points))
        EXPECT_TRUE(std::isfinite(value.x) && value.x >= 0) << settings << int(quantity);
}

}  // namespace
}  // namespace cuticle::bsdf::huang_gpu_test
