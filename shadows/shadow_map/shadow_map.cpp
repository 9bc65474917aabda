// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/shadow_map/depth_map.h"

namespace cuticle::shadows::shadow_map {
namespace {

constexpr std::string_view k_hair[] = {"opaque", "absorbing"};
constexpr registry::StudyCase k_cases[] = {
    {"one tap", "filter_texels=0"}, {"percentage-closer filter", "filter_texels=3"}, {"absorbing", "hair=absorbing"}};

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  describe_resolution(members, settings.map);
  describe_filter(members, settings.map);
  members.millimetres(settings.bias, "bias_mm", 0, 1000,
                      "depth behind the nearest fibre up to which a receiver is lit");
  members(settings.absorbing, "hair", k_hair,
          "opaque: nothing passes a fibre; absorbing: (1 - alpha)^(depth behind the nearest fibre / fibre_spacing_mm)");
  members.millimetres(settings.fibre_spacing, "fibre_spacing_mm", 0.001, 1000,
                      "absorbing: depth of hair for each fibre crossed");
}

/// Passes: fit, nearest, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<Settings, build_map, look_up>(
      {.name = "shadow_map",
       .summary = "the depth of the nearest fibre, percentage-closer filtered",
       .source = "Williams 1978; Reeves, Salesin and Cook 1987; absorbing: TressFX 4.1",
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>});
  return method;
}

}  // namespace cuticle::shadows::shadow_map
