#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::depth_of_field {

struct Parameters {
  static constexpr std::string_view name = "depth_of_field";
  double lens_radius = 5, focus = 0;
  std::uint32_t largest = 32, samples = 48;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::depth_of_field
