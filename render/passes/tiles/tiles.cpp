#include "render/passes/tiles/tiles.h"

#include "render/shading.h"

namespace cuticle::render::tiles {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_tiles"};
constexpr std::string_view k_after[] = {"head", "fins", "floor", "shade_strands", "tile_sort"};
constexpr std::string_view k_systems[] = {"F6", "F7", "F9"};
constexpr registry::Parameter k_parameters[] = {
    {.name = "opacity",
     .minimum = 0,
     .maximum = 1,
     .default_text = "1",
     .summary = "of a drawn strand where it covers a pixel whole; 'truth' draws with the same"},
    {.name = "coverage_rows",
     .type = registry::ParameterType::integer,
     .minimum = 0,
     .maximum = 16,
     .default_text = "8",
     .summary = "rows of 16 samples in a pixel, of which those that a strand covers are known; 0, and for strands that "
                "let light through or are blended by slices: its share of the pixel by a formula"},
    {.name = "chunk_px",
     .type = registry::ParameterType::integer,
     .unit = "px",
     .minimum = 0,
     .maximum = 4096,
     .default_text = "0",
     .summary = "side of the squares, rounded up to whole tiles, that the picture is drawn in one after the other; 0: "
                "all at once up to 4096 pixels each way, larger pictures by 1024"},
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
               .dispatches = always<2>,  // prepare, fine
               .draws = 1,
               .after = k_after});
  return pass;
}

}  // namespace cuticle::render::tiles
