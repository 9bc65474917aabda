#include "render/passes/lines/lines.h"

#include "render/shading.h"

namespace cuticle::render::lines {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"strands", "output_color", "drawn_by_lines"};
constexpr std::string_view k_after[] = {"head", "fins", "floor", "cull_strands", "dual_scattering"};
constexpr std::string_view k_systems[] = {"F10", "H12", "H15"};
constexpr Parameter k_parameters[] = {
    {.name = "width_px",
     .unit = "px",
     .minimum = 0,
     .maximum = 16,
     .default_text = "0",
     .summary =
         "line width in pixels of the picture, opaque; 0: as wide as the widest strand where it is nearest, with the "
         "opacity of a strand's own width"},
    {.name = "widest_px",
     .unit = "px",
     .minimum = 0.1,
     .maximum = 16,
     .default_text = "4",
     .summary = "limit of the derived width, in pixels of the picture"},
    {.name = "full_px",
     .unit = "px",
     .minimum = 0,
     .maximum = 1e9,
     .default_text = "0",
     .summary =
         "level of detail: pixels that the hair covers at which all of it is drawn; below, a share of the strands, "
         "wider, with fewer segments; 0: always all"},
    {.name = "packed",
     .type = ParameterType::boolean,
     .default_text = "false",
     .summary = "strands are packed to 12 bytes a vertex on the device, and these are drawn"},
    {.name = "tip_variation",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0",
     .summary = "share of the length that chance takes away from a drawn strand's tip"},
    {.name = "ambient",
     .minimum = 0,
     .maximum = 4,
     .default_text = "0.6",
     .summary = "strength of the approximation to light scattered many times; 0: single scattering only"},
    {.name = "variation",
     .minimum = 0,
     .maximum = 1,
     .default_text = "0",
     .summary = "difference between strands: tilt of their tangents and brightness"},
};

std::uint32_t dispatches(const registry::ParameterValues& values, const registry::FrameShape&) {
  return values.boolean("packed") ? 1 : 0;
}

}  // namespace

const Pass& entry() {
  static const Pass pass = of_whole_pictures(
      shading({.name = "lines",
               .summary = "strands as line primitives, shaded from the lookup tables, shadowed per vertex",
               .source = "Nguyen and Donnelly 2005, GPU Gems 2, chapter 23.3",
               .parameters = k_parameters,
               .demands = k_demands,
               .systems = k_systems,
               .dispatches = dispatches,
               .draws = 1,
               .after = k_after}));
  return pass;
}

}  // namespace cuticle::render::lines
