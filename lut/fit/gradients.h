#pragma once
// A model's values with their derivatives by its parameters.
#include <string>
#include <vector>

#include "bsdf/model.h"

namespace cuticle::lut {

struct Gradients {
  std::vector<std::string> names;   ///< of the parameters; an rgb's components are "sigma_a.r", ..
  std::vector<glm::dvec3> values;   ///< one a point, as evaluate() gives them in double
  std::vector<double> derivatives;  ///< [point][r, g, b][parameter], per unit of the parameter
};

/// S, M, N or A at points and its derivatives by named parameters (none named: all real and rgb ones), by ceres::Jet
/// through the model's formulas; the numbers that those prepare are differentiated by sixth-order differences.
/// Measured: within 1e-6 of the largest value or derivative against differences of evaluate() in double
/// (python/tests/test_models.py), but where other formulas take over at that very value (marschner: aspect = 1): those
/// of the formulas in force. Errors: usage, for another quantity, a name that is no real or rgb parameter, or a model
/// without derivatives (huang); those of bsdf::check_request.
Result<Gradients> evaluate_gradients(const bsdf::Model& model, const registry::ParameterValues& values,
                                     std::vector<std::string> names, const bsdf::Request& request);

}  // namespace cuticle::lut
