#include <cuticle/render/passes/tiles/tiles.h>

namespace cuticle::render::tiles {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_tiles"};
constexpr std::string_view k_after[] = {"head", "shade_strands", "tile_sort"};
constexpr std::string_view k_systems[] = {"F6", "F9"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "opacity",
     .minimum = 0,
     .maximum = 1,
     .default_text = "1",
     .summary = "of a drawn strand where it covers a pixel whole; 'truth' draws with the same"},
};

std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape&) { return 1; }

}  // namespace

const Pass& entry() {
  static const Pass pass{
      {.kind = registry::EntryKind::pass,
       .name = "tiles",
       .summary = "tiles to pixels: coverage by formula, blended from near to far, merged into the scene",
       .source = "Frostbite, Every Strand Counts (2023): fine rasteriser and resolve",
       .parameters = k_parameters,
       .demands = k_demands,
       .stage = registry::Stage::shade,
       .systems = k_systems,
       .dispatches = dispatches,
       .draws = 1,
       .after = k_after}};
  return pass;
}

}  // namespace cuticle::render::tiles
