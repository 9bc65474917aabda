// The registered method: parameters, demands, and the CPU evaluation.
#include <cuticle/shadows/detail/map_method.h>
#include <cuticle/shadows/fourier/fourier_map.h>
#include <cuticle/shadows/fourier/fourier.glslh>

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
    k_accumulate,
};
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr registry::StudyCase k_cases[] = {
    {"1 harmonic", "harmonics=1"}, {"3 harmonics", "harmonics=3"}, {"7 harmonics", "harmonics=7"}};

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  return evaluate_by_map("fourier", casters, receivers, settings, build_map, look_up,
                         [](const SeriesMap& map) { return 4 * map.sums.size(); });
}

/// Fit, splat, lookup; the clearing is a fill.
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return 3 * shape.lights;
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method,
                              "fourier",
                              "opacity over depth as a Fourier series (Fourier opacity map)",
                              "Jansen and Bavoil 2010, Fourier Opacity Mapping",
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

}  // namespace cuticle::shadows::fourier
