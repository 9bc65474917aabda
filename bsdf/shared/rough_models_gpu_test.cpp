// The kernels of d'Eon's model and of fur on the device against double on the CPU.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/model_on_device.h"

namespace cuticle::bsdf::rough_models_gpu_test {
namespace {

/// The largest difference over the largest value.
double relative_difference(std::string_view name, std::string_view settings, Quantity quantity,
                           const std::vector<Point>& points) {
  const Model& model = **find_model(name);
  const registry::ParameterValues values = *parse_settings(model, "", settings);
  std::vector<glm::dvec3> truth(points.size()), result(points.size());
  EXPECT_TRUE(evaluate(model, values, Precision::f64, {quantity, -1, points}, truth).ok());
  EXPECT_TRUE(tests::evaluator_of(model).evaluate(values, {quantity, -1, points}, result).ok());
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(result[i][c])) << settings << " point " << i;
      worst = std::max(worst, std::abs(truth[i][c] - result[i][c]));
      largest = std::max(largest, truth[i][c]);
    }
  return worst / largest;
}

std::vector<Point> spread_points(int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
    points.push_back({.theta_i = std::sin(i * 1.1) * 1.5,
                      .theta_o = std::sin(i * 2.3) * 1.5,
                      .theta_d = std::sin(i * 0.7) * 1.5,
                      .phi = 3.14 * std::sin(i * 0.9),
                      .h = 0.99 * std::sin(i * 0.31)});
  return points;
}

struct Case {
  const char *model, *settings;
};
class RoughModelsGpu : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Settings, RoughModelsGpu,
                         testing::Values(Case{"deon", "azimuthal_tolerance=1e-5"},
                                         Case{"deon", "azimuthal_tolerance=1e-5,r_lobe=non_separable,beta_n=0.05"},
                                         Case{"yan_fur", "azimuthal_tolerance=1e-4"},
                                         Case{"yan_fur", "field=near,g=-0.5,sigma_a=0.1/0.5/2,layers=2"}));
TEST_P(RoughModelsGpu, EveryQuantity_AgreesWithDouble) {
  const Case& c = GetParam();
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::pdf, Quantity::albedo})
    EXPECT_LE(relative_difference(c.model, c.settings, quantity, spread_points(200)), 2e-5)
        << c.model << " " << c.settings << " " << int(quantity);
}

class RoughModelsGpuEdges : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Settings, RoughModelsGpuEdges,
                         testing::Values(Case{"deon", "beta_m=0.001,beta_n=0.001,sigma_a=0"},
                                         Case{"deon", "beta_m=1,beta_n=1,sigma_a=100,eta=1.05"}, Case{"deon", "eta=3"},
                                         Case{"yan_fur", "beta_m=0.001,beta_n=0.001,sigma_a=0,sigma_ma=0"},
                                         Case{"yan_fur", "field=near,sigma_a=100,sigma_ms=100,kappa=0.99,g=0.9"},
                                         Case{"yan_fur", "kappa=0,sigma_ms=0,sigma_ma=0,eta=3"}));
TEST_P(RoughModelsGpuEdges, EdgesOfTheDomain_AreFinite) {
  for (Quantity quantity : {Quantity::S, Quantity::N, Quantity::pdf, Quantity::error})
    relative_difference(GetParam().model, GetParam().settings, quantity,
                        {{1.5707963, -1.5707963, 1.5707963, 3.14159, 1}, {0, 1.5707963, 0, 0, -1}});
}

}  // namespace
}  // namespace cuticle::bsdf::rough_models_gpu_test
