#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::ambient_occlusion {

struct Parameters {
  static constexpr std::string_view name = "ambient_occlusion";
  double radius = 20, strength = 0.7;
  std::uint32_t largest = 64, samples = 12;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::ambient_occlusion
