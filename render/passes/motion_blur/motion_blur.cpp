#include "render/passes/motion_blur/motion_blur.h"

#include "render/shading.h"

namespace cuticle::render::motion_blur {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_demands[] = {"output_color", "seen_segments", "motion_blur", "movement"};
constexpr std::string_view k_after[] = {"ambient_occlusion", "temporal_antialiasing", "depth_of_field"};
constexpr Parameter k_parameters[] = {
    {.name = "shutter",
     .unit = "frames",
     .minimum = 0,
     .maximum = 4,
     .default_text = "0.5",
     .summary = "how long it is open, half before and half after the frame's time"},
    {.name = "largest",
     .type = ParameterType::integer,
     .unit = "px",
     .minimum = 1,
     .maximum = 256,
     .default_text = "48",
     .summary = "way to either side that no blur passes"},
    {.name = "samples",
     .type = ParameterType::integer,
     .minimum = 1,
     .maximum = 256,
     .default_text = "24",
     .summary = "moments that each pixel is looked at in"},
};

}  // namespace

const Pass& entry() {
  static const Pass pass{.entry = {.kind = registry::EntryKind::pass,
                                   .name = "motion_blur",
                                   .summary = "the mean over an open shutter, from the picture, its depth "
                                              "and how its pixels move",
                                   .source = "moments gathered along the largest motion near a pixel "
                                             "(tiles of McGuire, Hennessy, "
                                             "Bukowski and Osman 2012)",
                                   .parameters = k_parameters,
                                   .demands = k_demands,
                                   .stage = registry::Stage::output,
                                   .dispatches = always<3>,  // reach, spread, pixels
                                   .after = k_after},
                         .whole_pictures = true};
  return pass;
}

}  // namespace cuticle::render::motion_blur
