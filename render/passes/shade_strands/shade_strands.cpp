#include "render/passes/shade_strands/shade_strands.h"

#include "render/shading.h"

namespace cuticle::render::shade_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "strand_colors"};
constexpr std::string_view k_after[] = {"tile_lists", "dual_scattering"};
constexpr std::string_view k_systems[] = {"F5"};
std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape&) {
  return registry::from_values<Parameters>(values).point_px > 0 ? 3 : 1;  // choose, shade, fill
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.point_px, "point_px", "px", 0, 1000,
          "pixels from shading point to shading point where a strand is nearest to the camera; vertices between points "
          "interpolate; 0: every vertex is a point");
}

const Pass& entry() {
  static const Pass pass =
      shading({.name = "shade_strands",
               .summary = "radiance at points of the strands that are seen, fewer where they are far, from the tables",
               .source = "Frostbite, Every Strand Counts (2023): strand-space shading",
               .parameters = registry::table_of<Parameters>(),
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = dispatches,
               .after = k_after});
  return pass;
}

}  // namespace cuticle::render::shade_strands
