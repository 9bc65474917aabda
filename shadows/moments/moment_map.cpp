#include "shadows/moments/moment_map.h"

#include "shadows/detail/map_method.h"
#include "shadows/fibres.glslh"
#include "shadows/moments/moments.glslh"
#include "shadows/series.glslh"

namespace cuticle::shadows::moments {
namespace {

float share_before(const SeriesMap& map, const Settings& settings, std::size_t texel, float depth, float power,
                   std::span<const OwnDeposit> own) {
  const float whole = map.sum(texel, 0, own), bias = stored_bias(float(settings.bias()), whole),
              overestimation = seen_overestimation(float(settings.overestimation), power);
  const auto moment = [&](std::size_t i) { return map.sum(texel, i, own) / whole; };
  if (settings.basis == Basis::trigonometric_4)
    return circle_share(glm::vec2(moment(1), moment(2)), glm::vec2(moment(3), moment(4)), bias, depth, overestimation);
  PowerMoments<float> moments{};
  for (std::size_t i = 0; i < map.functions; ++i) moments.b[i] = moment(i);
  return power_share(biased(moments, bias), 2 * depth - 1, overestimation, int(map.functions + 1) / 2);
}

/// The share of a texel's sum, which is not 0, before depth z; `power`: seen_power().
float share_at(const SeriesMap& map, const Settings& settings, std::size_t texel, float z, float power,
               std::span<const OwnDeposit> own) {
  const float depth = z / float(k_series_steps);
  return depth <= 0 ? 0 : depth >= 1 ? 1 : share_before(map, settings, texel, depth, power, own);
}

}  // namespace

double default_bias(Basis basis) { return basis == Basis::power_4 ? 1e-4 : basis == Basis::power_6 ? 1e-3 : 4e-4; }

std::vector<float> weights(const Settings& settings) {
  const bool trigonometric = settings.basis == Basis::trigonometric_4;
  return series_weights(settings.functions(), [=](std::size_t i, double depth) {
    if (!trigonometric || i == 0) return std::pow(2 * depth - 1, double(i));
    const glm::dvec2 turned = circle_point(double((i + 1) / 2) * depth);
    return i % 2 == 1 ? turned.x : turned.y;
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
    return [&, z, power](std::size_t texel, std::span<const OwnDeposit> own) {
      const float whole = map.sum(texel, 0, own), all = per_unit * whole;
      if (!(whole > 0)) return 0.0f;
      return exponent_of_part(all, seen_fibre(fibres_of(all, fibre), fibre, power),
                              share_at(map, settings, texel, z, power, own));
    };
  };
  return look_up_receivers(map.view, settings.map, float(k_series_steps), k_series_pieces_per_step, asked, at_depth);
}

}  // namespace cuticle::shadows::moments
