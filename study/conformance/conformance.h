#pragma once
// Tables of a model's values at easy and hard points, for people who implement the same model elsewhere.
#include <string>
#include <vector>

#include "bsdf/model.h"

namespace cuticle::study {

/// One value that an implementation has to meet.
struct ConformanceRow {
  std::string settings;  ///< every parameter of the model, as `--set` takes them
  bsdf::Quantity quantity = bsdf::Quantity::S;
  int lobe = -1;  ///< -1: the sum
  bsdf::Point point;
  glm::dvec3 value{0};
  double tolerance = 0;  ///< largest absolute difference of a channel
  bool hard = false;     ///< grazing or tangent directions, the fibre's edge, straight ahead or back
};

/// S of the sum and of each lobe, the density of the sampler (where it has one) and the albedo, in double, for four
/// fibres (narrow, blond, black, rough), in the near field too where the model has one. Tolerance: the largest of 1e-4
/// of the value, 1e-6 of the largest value of that column, 16 times what this program's float differs from its double,
/// and three times the model's own bound where it integrates numerically. All values are finite. Test:
/// conformance_test.
Result<std::vector<ConformanceRow>> conformance_rows(const bsdf::Model& model);

/// Columns model, settings, quantity, lobe, theta_i_deg, theta_o_deg, phi_deg, h, r, g, b, tolerance, hard.
std::string conformance_csv(const bsdf::Model& model, const std::vector<ConformanceRow>& rows);

}  // namespace cuticle::study
