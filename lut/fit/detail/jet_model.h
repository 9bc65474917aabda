#pragma once
// A model's formulas with derivatives. Private to lut/fit: each model's formulas are compiled with ceres::Jet in a unit
// of their own (jet_unit.cpp), behind plain arrays.
#include <span>
#include <vector>

#include "bsdf/model.h"
#include "lut/fit/detail/jet_tangents.h"

namespace cuticle::lut {

struct JetModel {
  const char* name;
  std::vector<double> (*pack)(const registry::ParameterValues&);
  /// `at`: the members of EvaluationPoint.
  void (*evaluate)(const PackedTangents& packed, int quantity, int lobe, const double at[6], RgbTangents& out);
};
/// All registered models; written by CMakeLists.txt.
std::span<const JetModel> jet_models();

}  // namespace cuticle::lut
