#pragma once
// Lobes and detectors as packed numbers, four each, in double; rough_packing.glslh reads them.
#include <cmath>

#include "bsdf/shared/rough_packing.glslh"

namespace cuticle::bsdf {

/// A lobe of M of that standard deviation in theta_i [rad] whose peak is at theta_i + theta_o = shift [rad].
inline void pack_longitudinal(double width, double shift, double* out) {
  pack_longitudinal(make_longitudinal_lobe(width, shift), out);
}

/// A wrapped Gaussian of that standard deviation [rad].
inline void pack_detector(double sigma, double* out) {
  const Detector<double> detector = make_detector(sigma);
  out[0] = detector.sigma;
  out[1] = detector.inverse;
  out[2] = detector.height;
  out[3] = detector.decay;
}

/// How far from its centre, in deviations, a detector counts: where it has fallen to a millionth of the tolerance.
inline double detector_reach(double tolerance) { return std::sqrt(-2 * std::log(tolerance * 1e-6)); }

}  // namespace cuticle::bsdf
