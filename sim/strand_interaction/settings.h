#pragma once
// The parameters of strand against strand.
#include "core/registry/members.h"

namespace cuticle::sim::strand_interaction {

struct Settings {
  static constexpr std::string_view name = "strand_interaction";
  double cell = 0.02, smoothing = 4, pressure = 0.3, onset = 1, most_acceleration = 50;
};
void describe(registry::Members& members, Settings& settings);

}  // namespace cuticle::sim::strand_interaction
