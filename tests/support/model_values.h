#pragma once
// Values of a model, for tests that ask for a few of them.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bsdf/model.h"

namespace cuticle::tests {

/// Evaluates a lobe of one model by index (-1: the sum) with settings over the defaults. A wrong setting fails the
/// test.
struct ValuesOf {
  std::string_view name;
  std::vector<glm::dvec3> operator()(const std::string& settings, bsdf::Quantity quantity, int lobe,
                                     const std::vector<bsdf::Point>& points,
                                     bsdf::Precision precision = bsdf::Precision::f64) const {
    const bsdf::Model& model = **bsdf::find_model(name);
    const auto values = bsdf::parse_settings(model, "", settings);
    EXPECT_TRUE(values.ok()) << (values.ok() ? "" : values.error().message);
    std::vector<glm::dvec3> out(points.size());
    EXPECT_TRUE(bsdf::evaluate(model, *values, precision, {quantity, lobe, points}, out).ok());
    return out;
  }
};
/// The same at one point, red alone.
struct ValueOf {
  std::string_view name;
  double operator()(const std::string& settings, bsdf::Quantity quantity, int lobe, const bsdf::Point& point,
                    bsdf::Precision precision = bsdf::Precision::f64) const {
    return ValuesOf{name}(settings, quantity, lobe, {point}, precision)[0].x;
  }
};

/// A lobe's values by its name, or "sum", in double. A wrong name fails the test.
inline std::vector<glm::dvec3> model_values(std::string_view model_name, const std::string& settings,
                                            bsdf::Quantity quantity, std::string_view lobe,
                                            const std::vector<bsdf::Point>& points) {
  return ValuesOf{model_name}(settings, quantity, *bsdf::find_lobe(**bsdf::find_model(model_name), lobe), points);
}

/// The same at one point.
inline glm::dvec3 model_value(std::string_view model_name, const std::string& settings, bsdf::Quantity quantity,
                              std::string_view lobe, const bsdf::Point& point) {
  return model_values(model_name, settings, quantity, lobe, {point})[0];
}

}  // namespace cuticle::tests
