#include "shadows/fourier/fourier_map.h"

#include <numbers>

#include "shadows/detail/map_method.h"
#include "shadows/fibres.glslh"
#include "shadows/fourier/fourier.glslh"
#include "shadows/series.glslh"

namespace cuticle::shadows::fourier {
namespace {

/// The share of a texel's sum `whole` before a depth (0 .. 1); ringing may leave 0 .. 1, where it is cut off.
float share_at(const SeriesMap& map, const Integrals<float>& basis, float depth, float whole, std::size_t texel,
               std::span<const OwnDeposit> own) {
  if (depth <= 0 || depth >= 1) return depth <= 0 ? 0.0f : 1.0f;
  float sum = 0;
  for (std::size_t i = 0; i < map.functions; ++i) sum += basis.of[i] * map.sum(texel, i, own);
  return std::clamp(sum / whole, 0.0f, 1.0f);
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
  const float per_unit = exponent_per_unit(settings.map, map.scale),
              fibre = map.scattered_fibre(settings.map, per_unit);
  const auto at_depth = [&](std::size_t, float z, float seen) {
    const float power = scattered_power(settings.map, seen);
    const float depth = seen_depth(z / float(k_series_steps), settings.harmonics, power);
    const Integrals<float> basis = integrals(depth, settings.harmonics, float(settings.smoothing));
    return [&map, per_unit, fibre, power, depth, basis, harmonics = settings.harmonics](
               std::size_t texel, std::span<const OwnDeposit> own) {
      const float whole = map.sum(texel, 0, own), all = per_unit * whole;
      if (!(whole > 0)) return 0.0f;
      const float count = fibres_of(all, fibre);
      return exponent_of_part(all, seen_fibre(count, fibre, power),
                              seen_share(share_at(map, basis, depth, whole, texel, own), harmonics, count, power));
    };
  };
  return look_up_receivers(map.view, settings.map, float(k_series_steps), k_series_pieces_per_step, asked, at_depth);
}

}  // namespace cuticle::shadows::fourier
