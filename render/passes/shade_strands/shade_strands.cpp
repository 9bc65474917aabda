#include <cuticle/render/shading.h>

namespace cuticle::render::shade_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "strand_colors"};
constexpr std::string_view k_after[] = {"tile_lists"};

}  // namespace

const Pass& entry() {
  static const Pass pass =
      shading({.name = "shade_strands",
               .summary = "radiance once per vertex of the strands that are seen, from the lookup tables",
               .source = "Frostbite, Every Strand Counts (2023): strand-space shading",
               .demands = k_demands,
               .dispatches = always<1>,
               .after = k_after});
  return pass;
}

}  // namespace cuticle::render::shade_strands
