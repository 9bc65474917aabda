// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/shadow_map/depth_map.h"

namespace cuticle::shadows::shadow_map {
namespace {

using registry::ParameterType;
constexpr std::string_view k_hair[] = {"opaque", "absorbing"};
constexpr registry::Parameter k_parameters[] = {
    k_resolution,
    k_filter_texels,
    k_filter_radius,
    {"bias_mm",
     ParameterType::real,
     "mm",
     0,
     1000,
     "1",
     {},
     "depth behind the nearest fibre up to which a receiver is lit"},
    {"hair", ParameterType::choice, "1", 0, 0, "opaque", k_hair,
     "opaque: nothing passes a fibre; absorbing: (1 - alpha)^(depth behind the nearest fibre / fibre_spacing_mm)"},
    {"fibre_spacing_mm",
     ParameterType::real,
     "mm",
     0.001,
     1000,
     "1",
     {},
     "absorbing: depth of hair for each fibre crossed"},
};
constexpr registry::StudyCase k_cases[] = {
    {"one tap", "filter_texels=0"}, {"percentage-closer filter", "filter_texels=3"}, {"absorbing", "hair=absorbing"}};

}  // namespace

/// Passes: fit, nearest, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<settings_from, build_map, look_up>(
      {.name = "shadow_map",
       .summary = "the depth of the nearest fibre, percentage-closer filtered",
       .source = "Williams 1978; Reeves, Salesin and Cook 1987; absorbing: TressFX 4.1",
       .parameters = k_parameters,
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>});
  return method;
}

}  // namespace cuticle::shadows::shadow_map
