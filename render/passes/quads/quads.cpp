#include "render/passes/quads/quads.h"

#include "render/shading.h"

namespace cuticle::render::quads {

namespace {

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_quads"};
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

const Pass& entry() {
  static const Pass pass = of_whole_pictures(
      shading({.name = "quads",
               .summary = "strands as strips that face the camera, each strand shaded once a pixel that it is seen in",
               .source = "Tafuri, Strand-based Hair Rendering in Frostbite (2019); HairWorks",
               .parameters = registry::table_of<Parameters>(),
               .demands = k_demands,
               .systems = k_systems,
               .draws = 2,
               .after = k_after}));
  return pass;
}

}  // namespace cuticle::render::quads
