// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/fourier/fourier.glslh"
#include "shadows/detail/map_method.h"
#include "shadows/fourier/fourier_map.h"

namespace cuticle::shadows::fourier {
namespace {

constexpr registry::StudyCase k_cases[] = {{"1 harmonic", "harmonics=1"},
                                           {"3 harmonics", "harmonics=3"},
                                           {"7 harmonics", "harmonics=7"},
                                           {"15 harmonics", "harmonics=15"}};

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  members(settings.harmonics, "harmonics", 1, k_max_harmonics,
          "pairs of coefficients beside the constant: 2 harmonics + 1 numbers a texel");
  members(settings.smoothing, "smoothing", "1", 0, 10,
          "harmonic k is damped by exp(-smoothing (k / harmonics)^2): less ringing, more blur");
  describe(members, settings.map);
}

/// Passes: fit, splat, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<Settings, build_map, look_up>(
      {.name = "fourier",
       .summary = "opacity over depth as a Fourier series (Fourier opacity map)",
       .source = "Jansen and Bavoil 2010, Fourier Opacity Mapping",
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>},
      is_poisson<Settings>);
  return method;
}

}  // namespace cuticle::shadows::fourier
