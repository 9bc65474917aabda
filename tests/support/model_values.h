#pragma once
// Values of a model, for tests that ask for a few of them.
#include <string>

#include <gtest/gtest.h>

#include <cuticle/bsdf/model.h>

namespace cuticle::tests {

/// A lobe's value (by name, or "sum") at one point, in double, with settings over the defaults. A wrong name or setting
/// fails the test.
inline glm::dvec3 model_value(std::string_view model_name, const std::string& settings, bsdf::Quantity quantity,
                              std::string_view lobe, const bsdf::Point& point) {
  const bsdf::Model& model = **bsdf::find_model(model_name);
  const auto values = bsdf::parse_settings(model, "", settings);
  EXPECT_TRUE(values.ok()) << (values.ok() ? "" : values.error().message);
  glm::dvec3 value(0);
  const int index = *bsdf::find_lobe(model, lobe);
  EXPECT_TRUE(bsdf::evaluate(model, *values, bsdf::Precision::f64, {quantity, index, {&point, 1}}, {&value, 1}).ok());
  return value;
}

}  // namespace cuticle::tests
