#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::tile_lists {

struct Parameters {
  static constexpr std::string_view name = "tile_lists";
  double budget_mib = 96, full_px = 0;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::tile_lists
