#pragma once
// Hair under water: it weighs less, and the water drags it along. The drag is that of moving air (sim/wind), larger.
#include "sim/wind/wind.h"

namespace cuticle::sim::water {

struct Water {
  static constexpr std::string_view name = "water";
  double density = 1000, fibre_density = 1300;
  glm::dvec3 current{0.1, 0, 0};
  double drag = 12, swell = 1, swell_frequency = 0.25;
};
void describe(registry::Members& members, Water& water);

/// Share of the weight that the displaced water carries.
inline double buoyancy(const Water& water) { return water.density / water.fibre_density; }
inline wind::Wind current(const Water& water) {
  return {water.current, water.drag, water.swell, water.swell_frequency};
}

}  // namespace cuticle::sim::water
