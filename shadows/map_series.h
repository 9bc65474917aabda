#pragma once
// Maps of optical depth weighted by functions of depth: what moments and Fourier coefficients share on the CPU.
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shadows/map_settings.h"
#include "shadows/map_view.h"
#include "shadows/mean_fibre.h"
#include "shadows/own_fibre.h"
#include "strands/groom.h"

namespace cuticle::shadows {

/// Pieces per depth step of a steep segment: it is cut where it passes 1/64 of the whole depth.
inline constexpr float k_series_pieces_per_step = 0.015625f;

/// Function i of depth 0 .. 1 at the middle of every depth step, value i of step s at s * functions + i; all in -1 ..
/// 1, the first of them 1.
std::vector<float> series_weights(std::size_t functions, const std::function<double(std::size_t, double)>& function);

/// A filled map: the sum over a texel's hair of sigma times function i is int(sums[texel * functions + i]) / scale.
struct SeriesMap {
  MapView view;
  double scale = 1;
  std::size_t functions = 1;
  std::vector<std::uint32_t> sums;
  std::vector<std::uint32_t> table;  ///< of deposits
  std::vector<float> weights;        ///< series_weights
  FibreSums fibre{};                 ///< over the sampled segments
  std::size_t bytes() const { return 4 * sums.size(); }
  /// Sum i of a texel without what the receiver's own fibre has left there.
  float sum(std::size_t texel, std::size_t i, std::span<const OwnDeposit> own) const;
  /// What the mean fibre counts in the exponent, where fibres lie at random depths; 0: sums that are proportional to
  /// opacity, which take hair as evenly spread.
  float scattered_fibre(const MapSettings& settings, float per_unit) const {
    return settings.accumulation.poisson ? 0.0f : fibre_exponent(fibre, table, per_unit);
  }
  /// What a deposit adds to sum i, as an unsigned number that wraps.
  std::uint32_t amount(std::uint32_t covered, std::uint32_t step, std::size_t i) const;
};
/// LookupPlace::power where fibres lie at random depths; else 1.
inline float scattered_power(const MapSettings& settings, float power) {
  return settings.accumulation.poisson ? 1.0f : power;
}

/// Fills a map; the same integers at any thread count, and as the GPU's (MapGpu_SameGroom_SameIntegers). Half of the
/// range of fixed_point_scale is left to the sign.
SeriesMap build_series(const strands::Groom& groom, double alpha, const LightAxes& axes, const MapSettings& settings,
                       std::size_t functions, std::vector<float> weights);

}  // namespace cuticle::shadows
