#pragma once
// Means of an azimuthal term over intervals of phi, through integrable infinite peaks. For lut and viz.
#include "lut/evaluate.h"

namespace cuticle::lut {

/// An interval of azimuth (radians, begin < end) at one theta_d.
using PhiInterval = bsdf::AzimuthInterval;
struct PhiAverages {
  std::vector<glm::dvec3> values;  ///< mean over phi, one per interval
  /// 1 where a caustic lies inside: the model says so, or a peak kept the quadrature from converging early.
  std::vector<std::uint8_t> singular;
};

/// The interval of phi that texture coordinates [u_begin, u_end] of an axis of phi or cos phi cover.
PhiInterval phi_interval(const TableLayout& table, int size, double u_begin, double u_end, double v);

/// Means of N for the channel's lobes: the model's own where the source has them, else Gauss-Kronrod 7/15, every piece
/// halved until its error estimate is below 5e-6 of the mean, at most 36 times. Measured against integrals in closed
/// form through inverse square root peaks: 2e-5 of the mean (AverageOverPhi in lut_average_test).
Result<PhiAverages> average_over_phi(const Source& source, const Channel& channel,
                                     std::span<const PhiInterval> intervals);

}  // namespace cuticle::lut
