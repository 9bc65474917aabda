#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::temporal_antialiasing {

struct Parameters {
  static constexpr std::string_view name = "temporal_antialiasing";
  std::uint32_t frames = 16;
  double spread = 1.5;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::temporal_antialiasing
