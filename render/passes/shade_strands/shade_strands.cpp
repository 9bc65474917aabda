#include "render/passes/shade_strands/shade_strands.h"

#include "render/frame.h"
#include "render/generating.h"
#include "render/inputs.h"
#include "render/passes/bake_tables/bake_tables.h"
#include "render/passes/dual_scattering/dual_scattering.h"
#include "render/passes/seen_vertices/seen_vertices.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/passes/tile_lists/tile_lists.h"
#include "render/shading.h"

namespace cuticle::render::shade_strands {

namespace {

constexpr std::string_view k_demands[] = {"strands"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<Lights>(),
                          reads<FibreMaterial>(),
                          reads<DrawnHair>(),
                          reads<Targets>(),
                          may_read<tile_lists::TileLists>(),
                          may_read<seen_vertices::SeenVertices>(),
                          may_read<bake_tables::Tables>(),
                          may_read<HairTransmittance>(),
                          may_read<surface_shadow::Maps>(),
                          may_read<dual_scattering::Terms>(),
                          writes<StrandColors>()};
constexpr std::string_view k_after[] = {"tile_lists", "seen_vertices", "dual_scattering"};
constexpr std::string_view k_systems[] = {"F5"};
std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape& shape) {
  const std::uint32_t parts = dispatches_of_drawn(shape, strands::k_color_bytes);
  return registry::from_values<Parameters>(values).point_px > 0 ? 1 + 2 * parts : parts;  // choose, shade, fill
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.point_px, "point_px", "px", 0, 1000,
          "pixels from shading point to shading point where a strand is nearest to the camera; vertices between points "
          "interpolate; 0: every vertex is a point");
}

namespace {

Pass make() {
  Pass pass = with_uses(
      shading({.name = "shade_strands",
               .summary = "radiance at points of the strands that are seen, fewer where they are far, from the tables",
               .source = "Frostbite, Every Strand Counts (2023): strand-space shading",
               .parameters = registry::table_of<Parameters>(),
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = dispatches,
               .after = k_after}),
      k_uses);
  pass.asks_model = true;
  return pass;
}

}  // namespace

const Pass& entry() {
  static const Pass pass = make();
  return pass;
}

}  // namespace cuticle::render::shade_strands
