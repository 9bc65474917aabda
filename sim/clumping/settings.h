#pragma once
// The parameters of clumping as numbers.
#include <cstdint>

#include "core/registry/parameter.h"

namespace cuticle::sim::clumping {

/// See entry.cpp for units, ranges and defaults.
struct Settings {
  double rate = 0, tightness = 0, profile = 1, noise = 0, strands_per_clump = 1;
  std::uint64_t seed = 0;
};
Settings make_settings(const registry::ParameterValues& values);

}  // namespace cuticle::sim::clumping
