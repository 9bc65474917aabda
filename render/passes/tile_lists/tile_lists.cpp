#include <cuticle/render/passes/tile_lists/tile_lists.h>

namespace cuticle::render::tile_lists {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_tiles"};
constexpr std::string_view k_after[] = {"head"};
constexpr std::string_view k_systems[] = {"F4"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "budget_mib",
     .unit = "MiB",
     .minimum = 0.01,
     .maximum = 4096,
     .default_text = "96",
     .summary = "memory of the tiles' lists; where it is too small, fewer and wider segments are drawn, and counted"},
};

/// Scene depth, count, scan, scatter.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 4; }

}  // namespace

const Pass& entry() {
  static const Pass pass{{.kind = registry::EntryKind::pass,
                          .name = "tile_lists",
                          .summary = "segments to lists of the screen's tiles, those behind the scene culled",
                          .source = "Frostbite, Every Strand Counts (2023): coarse rasteriser",
                          .parameters = k_parameters,
                          .demands = k_demands,
                          .stage = registry::Stage::shade,
                          .systems = k_systems,
                          .dispatches = dispatches,
                          .after = k_after}};
  return pass;
}

}  // namespace cuticle::render::tile_lists
