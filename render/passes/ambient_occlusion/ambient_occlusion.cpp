#include "render/passes/ambient_occlusion/ambient_occlusion.h"

#include "render/shading.h"

namespace cuticle::render::ambient_occlusion {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"output_color", "drawn_on_device", "ambient_occlusion"};
constexpr Parameter k_parameters[] = {
    {.name = "radius",
     .type = ParameterType::real,
     .unit = "mm",
     .minimum = 0.01,
     .maximum = 1e4,
     .default_text = "20",
     .summary = "of the sphere around a point in which what is open counts"},
    {.name = "strength",
     .type = ParameterType::real,
     .minimum = 0,
     .maximum = 1,
     .default_text = "0.7",
     .summary = "share of the light that is taken away where nothing is open"},
    {.name = "largest",
     .type = ParameterType::integer,
     .unit = "px",
     .minimum = 1,
     .maximum = 1024,
     .default_text = "64",
     .summary = "the sphere shrinks near the camera to this radius on the screen"},
    {.name = "samples",
     .type = ParameterType::integer,
     .minimum = 1,
     .maximum = 512,
     .default_text = "12",
     .summary = "pairs of lines through the sphere"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "ambient_occlusion",
                                   .summary = "darkens what lies in hollows of the depth that the picture sees",
                                   .source = "volumetric obscurance by line samples (Loos and Sloan 2010)",
                                   .parameters = k_parameters,
                                   .demands = k_demands,
                                   .stage = registry::Stage::output,
                                   .dispatches = always<1>},
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::ambient_occlusion
