// The registered method: parameters, demands, and the CPU evaluation.
#include <cuticle/shadows/detail/map_method.h>
#include <cuticle/shadows/shadow_map/depth_map.h>

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
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr registry::StudyCase k_cases[] = {
    {"one tap", "filter_texels=0"}, {"percentage-closer filter", "filter_texels=3"}, {"absorbing", "hair=absorbing"}};

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  return evaluate_by_map("shadow_map", casters, receivers, settings, build_map, look_up,
                         [](const Map& map) { return 4 * map.nearest.size(); });
}

/// Fit, nearest, lookup; the clearing is a fill.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return 3 * shape.lights;
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method,
                              "shadow_map",
                              "the depth of the nearest fibre, percentage-closer filtered",
                              "Williams 1978; Reeves, Salesin and Cook 1987; absorbing: TressFX 4.1",
                              k_parameters,
                              k_demands,
                              registry::Stage::shadow,
                              {},
                              k_cases,
                              dispatches,
                              0},
                             evaluate};
  return method;
}

}  // namespace cuticle::shadows::shadow_map
