#include "render/passes/seen_vertices/seen_vertices.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/tile_lists/tile_lists.h"
#include "render/passes/tile_sort/tile_sort.h"
#include "render/shading.h"

namespace cuticle::render::seen_vertices {

namespace {

constexpr std::string_view k_demands[] = {"strands", "hidden_vertices_unshaded"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<DrawnHair>(),
                          reads<Targets>(),
                          reads<tile_lists::TileLists>(),
                          reads<tile_sort::SortedLists>(),
                          writes<SeenVertices>()};
constexpr std::string_view k_after[] = {"tile_sort"};
constexpr std::string_view k_systems[] = {"F5"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.wanted, "wanted", "false: vertices behind other hair are shaded too, for the same picture");
}

const Pass& entry() {
  static const Pass pass = with_uses(
      shading({.name = "seen_vertices",
               .summary = "a list of the vertices that 'tiles' shows, where shading one costs more than looking for it",
               .source = "deferred shading (Deering et al. 1988), with segments in the place of pixels",
               .parameters = registry::table_of<Parameters>(),
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = always<4>,  // prepare, mark, bits, list
               .after = k_after}),
      k_uses);
  return pass;
}

}  // namespace cuticle::render::seen_vertices
