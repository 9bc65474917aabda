#include <cuticle/shadows/fourier/fourier_map.h>

#include <numbers>

#include <cuticle/shadows/detail/map_method.h>
#include <cuticle/shadows/fourier/fourier.glslh>
#include <cuticle/shadows/series.glslh>

namespace cuticle::shadows::fourier {
namespace {

/// The sum before depth z of a texel; ringing may leave 0 .. the whole, where it is cut off.
float sum_at(const SeriesMap& map, const Settings& settings, std::size_t texel, float z) {
  const float whole = map.sum(texel, 0);
  const float depth = z / float(k_series_steps);
  if (!(depth > 0) || !(whole > 0)) return 0;
  if (depth >= 1) return whole;
  const Integrals<float> basis = integrals(depth, settings.harmonics, float(settings.smoothing));
  float sum = 0;
  for (std::uint32_t i = 0; i < settings.functions(); ++i) sum += basis.of[i] * map.sum(texel, i);
  return std::clamp(sum, 0.0f, whole);
}

}  // namespace

Result<Settings> settings_from(const registry::ParameterValues& values) {
  Settings settings;
  settings.map = map_settings(values);
  settings.harmonics = std::uint32_t(values.integer("harmonics"));
  settings.smoothing = values.real("smoothing");
  CUTICLE_TRY(check_map_bytes("fourier", settings.functions(), settings.map.resolution));
  return settings;
}

std::vector<float> weights(const Settings& settings) {
  return series_weights(settings.functions(), [](std::size_t i, double depth) {
    const double angle = 2 * std::numbers::pi * double((i + 1) / 2) * depth;
    return i % 2 == 1 ? std::cos(angle) : i == 0 ? 1.0 : std::sin(angle);
  });
}

SeriesMap build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  return build_series(groom, alpha, axes, settings.map, settings.functions(), weights(settings));
}

std::vector<float> look_up(const SeriesMap& map, const Settings& settings, float filter,
                           std::span<const glm::vec3> points) {
  const auto sum = [&](std::size_t texel, float z) { return sum_at(map, settings, texel, z); };
  return look_up_points(map.view, settings.map, map.scale, filter, float(k_series_steps), points, sum);
}

}  // namespace cuticle::shadows::fourier
