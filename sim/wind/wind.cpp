#include "sim/wind/wind.h"

#include <cmath>
#include <numbers>

namespace cuticle::sim::wind {

Push push_at(const Wind& wind, double time) {
  const double swing = 1 + wind.gust * std::sin(2 * std::numbers::pi * wind.gust_frequency * time);
  return {wind.velocity * (wind.drag * swing), wind.drag};
}

}  // namespace cuticle::sim::wind
