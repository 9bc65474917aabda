#include "render/passes/tile_sort/tile_sort.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/tile_lists/tile_lists.h"
#include "render/shading.h"

namespace cuticle::render::tile_sort {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_tiles"};
constexpr Use k_uses[] = {reads<FrameView>(), reads<DrawnHair>(), reads<Targets>(), reads<tile_lists::TileLists>(),
                          writes<SortedLists>()};
constexpr std::string_view k_after[] = {"tile_lists"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(
      p.slices, "slices", 0, 256,
      "of each tile's depth range, to which 'tiles' gives fragments by their own depth, those of one blended in the "
      "order of their segments' vertices; 0: segments are sorted by depth");
}

const Pass& entry() {
  static const Pass pass =
      with_uses(shading({.name = "tile_sort",
                         .summary = "each tile's segments from near to far, in one definite order",
                         .source = "counting sort over up to 512 depths, then Shell's sort of each depth",
                         .parameters = registry::table_of<Parameters>(),
                         .demands = k_demands,
                         .dispatches = always<1>,
                         .after = k_after}),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::tile_sort
