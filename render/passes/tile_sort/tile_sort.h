#pragma once
#include "core/registry/members.h"
#include "render/pass.h"

namespace cuticle::render::tile_sort {

struct Parameters {
  static constexpr std::string_view name = "tile_sort";
  std::uint32_t slices = 0;
};
void describe(registry::Members& members, Parameters& parameters);

/// The lists of each tile from near to far.
struct SortedLists;
constexpr std::string_view resource_name(const SortedLists*) { return "sorted_lists"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::tile_sort
