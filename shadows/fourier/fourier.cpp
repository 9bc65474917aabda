// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/fourier/fourier_map.h"
#include "shadows/fourier/fourier.glslh"

namespace cuticle::shadows::fourier {
namespace {

using registry::ParameterType;
constexpr registry::Parameter k_parameters[] = {
    {"harmonics",
     ParameterType::integer,
     "1",
     1,
     k_most_harmonics,
     "3",
     {},
     "pairs of coefficients beside the constant: 2 harmonics + 1 numbers a texel"},
    {"smoothing",
     ParameterType::real,
     "1",
     0,
     10,
     "0",
     {},
     "harmonic k is damped by exp(-smoothing (k / harmonics)^2): less ringing, more blur"},
    k_resolution,
    k_optical_k,
    k_filter_texels,
    k_filter_radius,
    k_depth_offset,
    k_accumulate,
};
constexpr registry::StudyCase k_cases[] = {
    {"1 harmonic", "harmonics=1"}, {"3 harmonics", "harmonics=3"}, {"7 harmonics", "harmonics=7"}};

}  // namespace

/// Passes: fit, splat, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<settings_from, build_map, look_up>(
      {.name = "fourier",
       .summary = "opacity over depth as a Fourier series (Fourier opacity map)",
       .source = "Jansen and Bavoil 2010, Fourier Opacity Mapping",
       .parameters = k_parameters,
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>},
      is_poisson);
  return method;
}

}  // namespace cuticle::shadows::fourier
