// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/moments/moment_map.h"

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
    k_depth_offset,
    k_accumulate,
};
constexpr registry::StudyCase k_cases[] = {{"4 power moments", "basis=power_4"},
                                           {"6 power moments", "basis=power_6"},
                                           {"4 trigonometric moments", "basis=trigonometric_4"}};

}  // namespace

/// Passes: fit, splat, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<settings_from, build_map, look_up>(
      {.name = "moments",
       .summary = "moments of opacity over depth (moment shadow map)",
       .source = "Peters and Klein 2015; Muenstermann, Krumpen, Klein and Peters 2018",
       .parameters = k_parameters,
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>});
  return method;
}

}  // namespace cuticle::shadows::moments
