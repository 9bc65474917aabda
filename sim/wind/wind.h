#pragma once
// Moving air: uniform, gusting in time. Its drag is linear in the relative velocity and proportional to length, as a
// strand's mass is, so that it does not depend on how a strand is cut into segments.
#include <glm/vec3.hpp>

#include "core/registry/parameter.h"

namespace cuticle::sim::wind {

struct Wind {
  glm::dvec3 velocity{0};               ///< m/s, world
  double drag = 0;                      ///< 1/s: rate at which a free fibre takes on the air's velocity
  double gust = 0, gust_frequency = 0;  ///< share of the velocity by which it swings; 1/s
};
Wind make_wind(const registry::ParameterValues& values);

/// What the air does to a fibre of velocity v at one time: acceleration - drag v.
struct Push {
  glm::dvec3 acceleration{0};  ///< m/s^2
  double drag = 0;             ///< 1/s
};
/// time: seconds since the solver was made.
Push push_at(const Wind& wind, double time);

}  // namespace cuticle::sim::wind
