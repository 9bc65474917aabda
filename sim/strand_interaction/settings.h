#pragma once
// The parameters of strand against strand as numbers.
#include "core/registry/parameter.h"

namespace cuticle::sim::strand_interaction {

/// See entry.cpp for units, ranges and defaults.
struct Settings {
  double cell = 0, smoothing = 0, pressure = 0, onset = 1, most_acceleration = 0;
};
Settings make_settings(const registry::ParameterValues& values);

}  // namespace cuticle::sim::strand_interaction
