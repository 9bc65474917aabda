#pragma once
// Moment shadow maps of opacity: moments of the distribution of optical depth over depth in each texel.
#include <span>
#include <vector>

#include "shadows/map_series.h"
#include "shadows/own_fibre.h"

namespace cuticle::shadows::moments {

enum class Basis { power_4, power_6, trigonometric_4 };

/// Enough for the rounding of the stored integers (README.md).
double default_bias(Basis basis);

/// The method's parameters, in SI units.
struct Settings {
  MapSettings map{.method = "moments", .knows_depths = false};
  Basis basis = Basis::power_4;
  double given_bias = 0;        ///< 0: default_bias
  double overestimation = 0.5;  ///< share of the hair at the very depth asked for that counts as before it
  std::uint32_t functions() const { return basis == Basis::power_6 ? 7 : 5; }
  double bias() const { return given_bias > 0 ? given_bias : default_bias(basis); }
  Result<void> check() const { return check_map_bytes(map, functions()); }
};
void describe(registry::Members& members, Settings& settings);

/// 1, then the powers of depth -1 .. 1, or cosine and sine of one and two turns, at every depth step.
std::vector<float> weights(const Settings& settings);

/// Fills a map; the same integers at any thread count, and as the GPU's (MapGpu_SameGroom_SameIntegers).
SeriesMap build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings);

/// Transmittance at the receivers, one each, in [0, 1]; outside the map it is 1. Error: usage, for too wide a filter.
Result<std::vector<float>> look_up(const SeriesMap& map, const Settings& settings, const Asked& asked);

}  // namespace cuticle::shadows::moments
