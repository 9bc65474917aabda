#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::motion_blur {

struct Parameters {
  static constexpr std::string_view name = "motion_blur";
  double shutter = 0.5;
  std::uint32_t largest = 48, samples = 24;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::motion_blur
