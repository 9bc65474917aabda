#include <cuticle/render/passes/tiles/tiles.h>

#include <cuticle/render/shading.h>

namespace cuticle::render::tiles {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_tiles"};
constexpr std::string_view k_after[] = {"head", "fins", "shade_strands", "tile_sort"};
constexpr std::string_view k_systems[] = {"F6", "F7", "F9"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "opacity",
     .minimum = 0,
     .maximum = 1,
     .default_text = "1",
     .summary = "of a drawn strand where it covers a pixel whole; 'truth' draws with the same"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      shading({.name = "tiles",
               .summary = "tiles to pixels: coverage by formula, blended from near to far, merged into the scene",
               .source = "Frostbite, Every Strand Counts (2023): fine rasteriser and resolve",
               .parameters = k_parameters,
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = always<1>,
               .draws = 1,
               .after = k_after});
  return pass;
}

}  // namespace cuticle::render::tiles
