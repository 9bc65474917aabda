#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::shade_strands {

struct Parameters {
  static constexpr std::string_view name = "shade_strands";
  double point_px = 0;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::shade_strands
