#include "render/passes/lines/lines.h"

#include <algorithm>

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/bake_tables/bake_tables.h"
#include "render/passes/cull_strands/cull_strands.h"
#include "render/passes/dual_scattering/dual_scattering.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/shading.h"

namespace cuticle::render::lines {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_lines"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<Lights>(),
                          reads<FibreMaterial>(),
                          reads<DrawnHair>(),
                          reads<Targets>(),
                          may_read<bake_tables::Tables>(),
                          may_read<HairTransmittance>(),
                          may_read<surface_shadow::Maps>(),
                          may_read<dual_scattering::Terms>(),
                          may_read<cull_strands::SeenStrands>(),
                          may_read<DrawnSurfaces>(),
                          writes<SeenHair>(),
                          writes<StrandPixels>()};
constexpr std::string_view k_after[] = {"head", "fins", "floor", "cull_strands", "dual_scattering"};
constexpr std::string_view k_systems[] = {"F10", "H12", "H15"};

std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape&) {
  return registry::from_values<Parameters>(values).packed ? 1 : 0;
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.width_px, "width_px", "px", 0, 16,
          "line width in pixels of the picture, opaque; 0: as wide as the widest strand where it is nearest, with the "
          "opacity of a strand's own width");
  members(p.widest_px, "widest_px", "px", 0.1, 16, "limit of the derived width, in pixels of the picture");
  members(p.full_px, "full_px", "px", 0, 1e9,
          "level of detail: pixels that the hair covers at which all of it is drawn; below, a share of the strands, "
          "wider, with fewer segments; 0: always all");
  members(p.packed, "packed", "strands are packed to 12 bytes a vertex on the device, and these are drawn");
  members(p.tip_variation, "tip_variation", "1", 0, 1,
          "share of the length that chance takes away from a drawn strand's tip");
  members(p.ambient, "ambient", "1", 0, 4,
          "strength of the approximation to light scattered many times; 0: single scattering only");
  members(p.variation, "variation", "1", 0, 1, "difference between strands: tilt of their tangents and brightness");
}

namespace {

/// 4 samples where the device offers them: only the strands' own draws read the depth.
TargetShape targets(const PassParameters&, std::span<const int> offered) {
  return {.samples = std::ranges::find(offered, 4) != offered.end() ? 4 : 1};
}

StrandDraw strand_draw(const PassParameters& all) {
  return {.full_px = parameters_of<Parameters>(all).full_px,
          .corners = k_corners,
          .of_one_width = true,
          .whole_segments = true};
}

Pass make() {
  Pass pass = of_whole_pictures(
      shading({.name = "lines",
               .summary = "strands as line primitives, shaded from the lookup tables, shadowed per vertex",
               .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23.3",
               .parameters = registry::table_of<Parameters>(),
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = dispatches,
               .draws = 1,
               .after = k_after}));
  pass.uses = k_uses;
  pass.targets = targets;
  pass.strand_draw = strand_draw;
  pass.asks_model = true;
  return pass;
}

}  // namespace

const Pass& entry() {
  static const Pass pass = make();
  return pass;
}

}  // namespace cuticle::render::lines
