#include "render/passes/tile_lists/tile_lists.h"

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/strands_in_sight/strands_in_sight.h"
#include "render/shading.h"

namespace cuticle::render::tile_lists {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_tiles"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<DrawnHair>(),
                          reads<Targets>(),
                          may_read<DrawnSurfaces>(),
                          may_read<strands_in_sight::StrandsInSight>(),
                          writes<TileLists>()};
constexpr std::string_view k_after[] = {"head", "fins", "floor"};
constexpr std::string_view k_systems[] = {"F4"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.budget_mib, "budget_mib", "MiB", 0.01, 4096,
          "memory of the tiles' lists; where it is too small, fewer and wider segments are drawn, and counted");
  members(p.full_px, "full_px", "px", 0, 1e9,
          "level of detail: pixels that the hair covers at which all of it is drawn; below, a share of the strands, "
          "wider, that let light through; 0: always all");
  members(p.lanes, "lanes", 0, 64,
          "invocations that draw a tile: 8, 32 or 64 (another number is the next of these below it, or 8); 0: as suits "
          "the device");
  members(
      p.whole_segments, "whole_segments",
      "true: a segment with parts (groom.segment_parts) is drawn as one, with the light of their ends, faster; what "
      "of it shows within a pixel is not told apart");
}

namespace {

StrandDraw strand_draw(const PassParameters& all) { return {.full_px = parameters_of<Parameters>(all).full_px}; }

Pass make() {
  Pass pass = with_uses(shading({.name = "tile_lists",
                                 .summary = "segments to lists of the screen's tiles, those behind the scene culled",
                                 .source = "Frostbite, Every Strand Counts (2023): coarse rasteriser",
                                 .parameters = registry::table_of<Parameters>(),
                                 .demands = k_demands,
                                 .systems = k_systems,
                                 .dispatches = always<4>,  // scene depth, count, scan, scatter
                                 .after = k_after}),
                        k_uses);
  pass.strand_draw = strand_draw;
  return pass;
}

}  // namespace

const Pass& entry() {
  static const Pass pass = make();
  return pass;
}

}  // namespace cuticle::render::tile_lists
