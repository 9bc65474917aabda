#pragma once
// A model's values and their derivatives by named parameters, at many points. Private to lut/fit.
#include <string>
#include <vector>

#include "lut/fit/detail/jet_model.h"
#include "lut/fit/model_fit.h"

namespace cuticle::lut {

/// A real parameter, or a component of an rgb (-1: all three together).
struct FreeParameter {
  std::string name;
  const registry::Parameter* parameter = nullptr;
  int component = -1;

  double get(const registry::ParameterValues& values) const;
  void set(registry::ParameterValues& values, double value) const;
  double range() const { return parameter->maximum - parameter->minimum; }
};

/// The names as scalars; an rgb gives three, or one where `grey`. Error: usage, listing what may be free.
Result<std::vector<FreeParameter>> free_parameters(const bsdf::Model& model, const std::vector<std::string>& names,
                                                   bool grey);
/// Error: usage, where the model's formulas do not compile with ceres::Jet.
Result<const JetModel*> find_jet_model(const bsdf::Model& model);

/// Values of rows, and derivatives [row][component][parameter]. Jets go through the model's formulas; what those read
/// (the prepared numbers) is differentiated by sixth-order differences of the model's own packing.
struct Tangents {
  std::vector<glm::dvec3> values;
  std::vector<double> gradients;
};
Tangents evaluate_tangents(const JetModel& model, const registry::ParameterValues& values,
                           const std::vector<FreeParameter>& free, const Measurements& measurements);
/// The same by central differences of the model's values in double, within the parameters' ranges; derivatives of 0
/// where they are not `sloped`.
Tangents difference_tangents(const bsdf::Model& model, const registry::ParameterValues& values,
                             const std::vector<FreeParameter>& free, const Measurements& measurements, bool sloped);

}  // namespace cuticle::lut
