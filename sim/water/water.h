#pragma once
// Hair under water: it weighs less, and the water drags it along. The drag is that of moving air (sim/wind), larger.
#include "sim/wind/wind.h"

namespace cuticle::sim::water {

struct Water {
  double buoyancy =
      0;  ///< share of the weight that the displaced water carries: density of water over that of the fibre
  wind::Wind current;
};
Water make_water(const registry::ParameterValues& values);

}  // namespace cuticle::sim::water
