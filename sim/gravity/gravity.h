#pragma once
// A constant acceleration, folded into the integration of every solver.
#include "sim/solver.h"

namespace cuticle::sim::gravity {

struct Gravity {
  static constexpr std::string_view name = "gravity";
  glm::dvec3 acceleration{0, -9.80665, 0};
};
void describe(registry::Members& members, Gravity& gravity);

}  // namespace cuticle::sim::gravity
