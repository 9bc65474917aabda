#pragma once
// Fourier opacity maps (Jansen and Bavoil 2010): the coefficients of a texel's opacity over depth.
#include <span>
#include <vector>

#include "shadows/map_series.h"
#include "shadows/own_fibre.h"

namespace cuticle::shadows::fourier {

/// The method's parameters, in SI units.
struct Settings {
  MapSettings map{.method = "fourier", .knows_depths = false};
  std::uint32_t harmonics = 15;
  double smoothing = 0;
  std::uint32_t functions() const { return 2 * harmonics + 1; }
  Result<void> check() const { return check_map_bytes(map, functions()); }
};
void describe(registry::Members& members, Settings& settings);

/// 1, then cos and sin of each harmonic, at every depth step.
std::vector<float> weights(const Settings& settings);

/// Fills a map; the same integers at any thread count, and as the GPU's (MapGpu_SameGroom_SameIntegers).
SeriesMap build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings);

/// Transmittance at the receivers, one each, in [0, 1]; outside the map it is 1. Error: usage, for too wide a filter.
Result<std::vector<float>> look_up(const SeriesMap& map, const Settings& settings, const Asked& asked);

}  // namespace cuticle::shadows::fourier
