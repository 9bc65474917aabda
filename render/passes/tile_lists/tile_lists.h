#pragma once
#include "core/registry/members.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::tile_lists {

struct Parameters {
  static constexpr std::string_view name = "tile_lists";
  double budget_mib = 96, full_px = 0;
  std::uint32_t lanes = 0;
  bool whole_segments = false;
};
void describe(registry::Members& members, Parameters& parameters);

/// Which segments each tile of the screen has to draw.
struct TileLists;
constexpr std::string_view resource_name(const TileLists*) { return "tile_lists"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::tile_lists
