#pragma once
// Moving air: uniform, gusting in time. Its drag is linear in the relative velocity and proportional to length, as a
// strand's mass is, so that it does not depend on how a strand is cut into segments.
#include <glm/vec3.hpp>

#include "core/registry/members.h"
#include "sim/push.h"

namespace cuticle::sim::wind {

struct Wind {
  static constexpr std::string_view name = "wind";
  glm::dvec3 velocity{2, 0, 0};
  double drag = 3, gust = 0.5, gust_frequency = 0.7;
};
void describe(registry::Members& members, Wind& wind);

/// time: seconds since the solver was made.
Push push_at(const Wind& wind, double time);

}  // namespace cuticle::sim::wind
