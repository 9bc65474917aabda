#include "shadows/fourier/fourier_map.h"

#include <numbers>

#include "shadows/detail/map_method.h"
#include "shadows/fourier/fourier.glslh"
#include "shadows/series.glslh"

namespace cuticle::shadows::fourier {
namespace {

/// The sum before a depth (0 .. 1) of a texel; ringing may leave 0 .. the whole, where it is cut off.
float sum_at(const SeriesMap& map, const Integrals<float>& basis, float depth, std::size_t texel,
             std::span<const OwnDeposit> own) {
  const float whole = map.sum(texel, 0, own);
  if (!(depth > 0) || !(whole > 0)) return 0;
  if (depth >= 1) return whole;
  float sum = 0;
  for (std::size_t i = 0; i < map.functions; ++i) sum += basis.of[i] * map.sum(texel, i, own);
  return std::clamp(sum, 0.0f, whole);
}

}  // namespace

std::vector<float> weights(const Settings& settings) {
  return series_weights(settings.functions(), [](std::size_t i, double depth) {
    const double angle = 2 * std::numbers::pi * double((i + 1) / 2) * depth;
    return i % 2 == 1 ? std::cos(angle) : i == 0 ? 1.0 : std::sin(angle);
  });
}

SeriesMap build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  return build_series(groom, alpha, axes, settings.map, settings.functions(), weights(settings));
}

Result<std::vector<float>> look_up(const SeriesMap& map, const Settings& settings, const Asked& asked) {
  const float per_unit = exponent_per_unit(settings.map, map.scale);
  const auto at_depth = [&](std::size_t, float z) {
    const float depth = z / float(k_series_steps);
    const Integrals<float> basis = integrals(depth, settings.harmonics, float(settings.smoothing));
    return [&map, per_unit, depth, basis](std::size_t texel, std::span<const OwnDeposit> own) {
      return per_unit * sum_at(map, basis, depth, texel, own);
    };
  };
  return look_up_receivers(map.view, settings.map, float(k_series_steps), k_series_pieces_per_step, asked, at_depth);
}

}  // namespace cuticle::shadows::fourier
