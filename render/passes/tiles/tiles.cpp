#include "render/passes/tiles/tiles.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/seen_vertices/seen_vertices.h"
#include "render/passes/shade_strands/shade_strands.h"
#include "render/passes/tile_lists/tile_lists.h"
#include "render/passes/tile_sort/tile_sort.h"
#include "render/shading.h"

namespace cuticle::render::tiles {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_tiles"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<DrawnHair>(),
                          reads<Targets>(),
                          reads<tile_lists::TileLists>(),
                          reads<tile_sort::SortedLists>(),
                          reads<shade_strands::StrandColors>(),
                          may_read<seen_vertices::SeenVertices>(),
                          may_read<DrawnSurfaces>(),
                          writes<SeenHair>(),
                          writes<StrandPixels>()};
constexpr std::string_view k_after[] = {"head", "fins", "floor", "shade_strands", "tile_sort"};
constexpr std::string_view k_systems[] = {"F6", "F7", "F9"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.opacity, "opacity", "1", 0, 1,
          "of a drawn strand where it covers a pixel whole; 'supersampled' draws with the same");
  members(p.coverage_rows, "coverage_rows", 0, 16,
          "rows of 32 samples in a pixel, of which those that a strand covers are known; 0, and for strands that "
          "let light through or are blended by slices: its share of the pixel by a formula");
  members(p.chunk_px,
          registry::row("chunk_px", "px", 0, 4096,
                        "side of the squares, rounded up to whole tiles, that the picture is drawn in one after the "
                        "other; 0: all at once up to 4096 pixels each way, larger pictures by 1024"));
}

namespace {

int chunk_px(const PassParameters& all) { return int(parameters_of<Parameters>(all).chunk_px); }

Pass make() {
  Pass pass = with_uses(
      shading({.name = "tiles",
               .summary = "tiles to pixels: coverage by formula, blended from near to far, merged into the scene",
               .source = "Frostbite, Every Strand Counts (2023): fine rasteriser and resolve",
               .parameters = registry::table_of<Parameters>(),
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = always<2>,  // prepare, fine
               .draws = 1,
               .after = k_after}),
      k_uses);
  pass.chunk_px = chunk_px;
  return pass;
}

}  // namespace

const Pass& entry() {
  static const Pass pass = make();
  return pass;
}

}  // namespace cuticle::render::tiles
