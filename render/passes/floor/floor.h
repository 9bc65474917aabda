#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::floor {

struct Parameters {
  static constexpr std::string_view name = "floor";
  double ambient = 0.05;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::floor
