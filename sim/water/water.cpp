#include "sim/water/water.h"

namespace cuticle::sim::water {

Water make_water(const registry::ParameterValues& values) {
  return {values.real("density") / values.real("fibre_density"),
          {values.rgb("current"), values.real("drag"), values.real("swell"), values.real("swell_frequency")}};
}

}  // namespace cuticle::sim::water
