// The registered method: parameters, demands, and the CPU evaluation.
#include <cuticle/shadows/detail/map_method.h>
#include <cuticle/shadows/moments/moment_map.h>

namespace cuticle::shadows::moments {
namespace {

using registry::ParameterType;
constexpr std::string_view k_bases[] = {"power_4", "power_6", "trigonometric_4"};
constexpr registry::Parameter k_parameters[] = {
    {"basis", ParameterType::choice, "1", 0, 0, "power_4", k_bases,
     "4 or 6 powers of depth, or 4 trigonometric moments (two complex ones)"},
    {"bias",
     ParameterType::real,
     "1",
     0,
     0.1,
     "0",
     {},
     "mixes the moments with those of evenly spread hair; 0: 1e-4 (power_4), 1e-3 (power_6), 4e-4 (trigonometric_4)"},
    {"overestimation",
     ParameterType::real,
     "1",
     0,
     1,
     "0.5",
     {},
     "between the least (0) and the most (1) optical depth that the moments allow"},
    k_resolution,
    k_optical_k,
    k_filter_texels,
    k_filter_radius,
    k_accumulate,
};
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr registry::StudyCase k_cases[] = {{"4 power moments", "basis=power_4"},
                                           {"6 power moments", "basis=power_6"},
                                           {"4 trigonometric moments", "basis=trigonometric_4"}};

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  return evaluate_by_map("moments", casters, receivers, settings, build_map, look_up,
                         [](const SeriesMap& map) { return 4 * map.sums.size(); });
}

/// Fit, splat, lookup; the clearing is a fill.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return 3 * shape.lights;
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method,
                              "moments",
                              "moments of opacity over depth (moment shadow map)",
                              "Peters and Klein 2015; Muenstermann, Krumpen, Klein and Peters 2018",
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

}  // namespace cuticle::shadows::moments
