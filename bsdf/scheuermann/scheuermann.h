#pragma once
// The model's parameters.
#include "core/registry/members.h"

namespace cuticle::bsdf::scheuermann {

struct Parameters {
  glm::dvec3 base{1};
  double occlusion = 1;
  glm::dvec3 diffuse{0.12}, primary{0.025};
  double primary_exponent = 100, primary_shift = 0.05;
  glm::dvec3 secondary{0.01};
  double secondary_exponent = 25, secondary_shift = -0.08, shift_texture = 0.5, mask = 1;
};
void describe(registry::Members& members, Parameters& p);

}  // namespace cuticle::bsdf::scheuermann
