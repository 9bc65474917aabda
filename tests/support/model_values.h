#pragma once
// Values of a model, for tests that ask for a few of them.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <cuticle/bsdf/model.h>

namespace cuticle::tests {

/// A lobe's values (by name, or "sum") at points, in double, with settings over the defaults. A wrong name or setting
/// fails the test.
inline std::vector<glm::dvec3> model_values(std::string_view model_name, const std::string& settings,
                                            bsdf::Quantity quantity, std::string_view lobe,
                                            const std::vector<bsdf::Point>& points) {
  const bsdf::Model& model = **bsdf::find_model(model_name);
  const auto values = bsdf::parse_settings(model, "", settings);
  EXPECT_TRUE(values.ok()) << (values.ok() ? "" : values.error().message);
  std::vector<glm::dvec3> out(points.size());
  const int index = *bsdf::find_lobe(model, lobe);
  EXPECT_TRUE(bsdf::evaluate(model, *values, bsdf::Precision::f64, {quantity, index, points}, out).ok());
  return out;
}

/// The same at one point.
inline glm::dvec3 model_value(std::string_view model_name, const std::string& settings, bsdf::Quantity quantity,
                              std::string_view lobe, const bsdf::Point& point) {
  return model_values(model_name, settings, quantity, lobe, {point})[0];
}

}  // namespace cuticle::tests
