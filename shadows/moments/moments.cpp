// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/moments/moment_map.h"

namespace cuticle::shadows::moments {
namespace {

constexpr std::string_view k_bases[] = {"power_4", "power_6", "trigonometric_4"};
constexpr registry::StudyCase k_cases[] = {{"4 power moments", "basis=power_4"},
                                           {"6 power moments", "basis=power_6"},
                                           {"4 trigonometric moments", "basis=trigonometric_4"}};

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  members(settings.basis, "basis", k_bases, "4 or 6 powers of depth, or 4 trigonometric moments (two complex ones)");
  members(settings.given_bias, "bias", "1", 0, 0.1,
          "mixes the moments with those of evenly spread hair; 0: 1e-4 (power_4), 1e-3 (power_6), 4e-4 "
          "(trigonometric_4)");
  members(settings.overestimation, "overestimation", "1", 0, 1,
          "between the least (0) and the most (1) optical depth that the moments allow");
  describe(members, settings.map);
}

/// Passes: fit, splat, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<Settings, build_map, look_up>(
      {.name = "moments",
       .summary = "moments of opacity over depth (moment shadow map)",
       .source = "Peters and Klein 2015; Muenstermann, Krumpen, Klein and Peters 2018",
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>});
  return method;
}

}  // namespace cuticle::shadows::moments
