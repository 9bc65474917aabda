#include "render/passes/quads/quads.h"

#include <algorithm>

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/bake_tables/bake_tables.h"
#include "render/passes/cull_strands/cull_strands.h"
#include "render/passes/dual_scattering/dual_scattering.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/shading.h"

namespace cuticle::render::quads {

namespace {

constexpr std::string_view k_demands[] = {"strands", "drawn_by_quads"};
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
constexpr std::string_view k_systems[] = {"F1", "F10", "H10", "H12"};

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.samples, "samples", 1, 16, "of a pixel (multisampling): 1, 2, 4, 8 or 16, as the device offers");
  members(p.root_width, "root_width", "1", 0, 16, "factor on a strand's width at its root");
  members(p.tip_width, "tip_width", "1", 0, 16, "factor on a strand's width at its tip");
  members(p.taper_power, "taper_power", "1", 0.1, 10, "above 1 the width stays near that of the root for longer");
  members(p.full_px, "full_px", "px", 0, 1e9,
          "level of detail, as that of 'lines': pixels from which on all strands are drawn; 0: always all");
}

namespace {

/// Multisampling alone.
TargetShape targets(const PassParameters& all, std::span<const int>) {
  return {.supersampling = 1, .samples = int(parameters_of<Parameters>(all).samples)};
}

StrandDraw strand_draw(const PassParameters& all) {
  const auto parameters = parameters_of<Parameters>(all);
  return {.full_px = parameters.full_px,
          .corners = k_corners,
          .width_factor = std::max(parameters.root_width, parameters.tip_width)};
}

Pass make() {
  Pass pass = with_uses(
      of_whole_pictures(shading(
          {.name = "quads",
           .summary = "strands as strips that face the camera, each strand shaded once a pixel that it is seen in",
           .source = "Tafuri, Strand-based Hair Rendering in Frostbite (2019); HairWorks",
           .parameters = registry::table_of<Parameters>(),
           .demands = k_demands,
           .systems = k_systems,
           .draws = 2,
           .after = k_after})),
      k_uses);
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

}  // namespace cuticle::render::quads
