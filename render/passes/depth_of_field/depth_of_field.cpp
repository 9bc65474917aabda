#include "render/passes/depth_of_field/depth_of_field.h"

#include "render/shading.h"

namespace cuticle::render::depth_of_field {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"output_color", "drawn_on_device", "depth_of_field"};
constexpr std::string_view k_after[] = {"ambient_occlusion", "temporal_antialiasing"};
constexpr Parameter k_parameters[] = {
    {.name = "lens_radius",
     .type = ParameterType::real,
     .unit = "mm",
     .minimum = 0,
     .maximum = 1000,
     .default_text = "5",
     .summary = "of the lens's opening; the focal length over twice this is the f-number"},
    {.name = "focus",
     .type = ParameterType::real,
     .unit = "m",
     .minimum = 0,
     .maximum = 1e4,
     .default_text = "0",
     .summary = "distance along the view that is sharp; 0: of what the camera looks at"},
    {.name = "largest",
     .type = ParameterType::integer,
     .unit = "px",
     .minimum = 1,
     .maximum = 128,
     .default_text = "32",
     .summary = "radius that no disc of blur passes"},
    {.name = "samples",
     .type = ParameterType::integer,
     .minimum = 1,
     .maximum = 1024,
     .default_text = "48",
     .summary = "pixels that are looked at for what lies before a pixel, and as many for the rest"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass{
      .entry = {.kind = registry::EntryKind::pass,
                .name = "depth_of_field",
                .summary = "the picture as a lens of finite width sees it, from its colour and depth",
                .source = "thin lens; gathered as scattered discs, what lies in front apart",
                .parameters = k_parameters,
                .demands = k_demands,
                .stage = registry::Stage::output,
                .dispatches = always<3>,  // reach, spread, pixels
                .after = k_after},
      .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::depth_of_field
