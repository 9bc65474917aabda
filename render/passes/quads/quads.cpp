#include "render/passes/quads/quads.h"

#include "render/shading.h"

namespace cuticle::render::quads {

namespace {

using registry::Parameter;

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_quads"};
constexpr std::string_view k_after[] = {"head", "fins", "floor", "cull_strands", "dual_scattering"};
constexpr std::string_view k_systems[] = {"F1", "F10", "H10", "H12"};
constexpr Parameter k_parameters[] = {
    {.name = "samples",
     .type = registry::ParameterType::integer,
     .minimum = 1,
     .maximum = 16,
     .default_text = "4",
     .summary = "of a pixel (multisampling): 1, 2, 4, 8 or 16, as the device offers"},
    {.name = "root_width",
     .minimum = 0,
     .maximum = 16,
     .default_text = "1",
     .summary = "factor on a strand's width at its root"},
    {.name = "tip_width",
     .minimum = 0,
     .maximum = 16,
     .default_text = "1",
     .summary = "factor on a strand's width at its tip"},
    {.name = "taper_power",
     .minimum = 0.1,
     .maximum = 10,
     .default_text = "1",
     .summary = "above 1 the width stays near that of the root for longer"},
    {.name = "full_px",
     .unit = "px",
     .minimum = 0,
     .maximum = 1e9,
     .default_text = "0",
     .summary = "level of detail, as that of 'lines': pixels from which on all strands are drawn; 0: always all"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass = of_whole_pictures(
      shading({.name = "quads",
               .summary = "strands as strips that face the camera, each strand shaded once a pixel that it is seen in",
               .source = "Tafuri, Strand-based Hair Rendering in Frostbite (2019); HairWorks",
               .parameters = k_parameters,
               .demands = k_demands,
               .systems = k_systems,
               .draws = 2,
               .after = k_after}));
  return pass;
}

}  // namespace cuticle::render::quads
