#pragma once
// The model's parameters.
#include "core/registry/members.h"

namespace cuticle::bsdf::chiang {

enum class Field { near, far };
struct Parameters {
  double eta = 1.55;
  glm::dvec3 sigma_a{0.2};
  double beta_m = 0.3, beta_n = 0.3, alpha = 0.034906585039886591;
  Field field = Field::far;
  double h_from = -1, h_to = 1, tolerance = 1e-5;
};
void describe(registry::Members& members, Parameters& p);

}  // namespace cuticle::bsdf::chiang
