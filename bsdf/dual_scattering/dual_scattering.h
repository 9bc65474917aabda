#pragma once
// The terms of dual scattering (Zinke, Yuksel, Weber, Keyser 2008) of any fibre model, by quadrature of its S: what an
// average scattering sends on and back, where, and how much comes back out of many fibres.
#include <vector>

#include <glm/vec3.hpp>

#include "bsdf/model.h"

namespace cuticle::bsdf {

/// What a fibre sends into one half of the azimuths: its share of the light, the mean of theta_i + theta_o over it, and
/// the standard deviation of that sum (both 0 where the share is 0). Radians, per colour.
struct HalfScattering {
  glm::dvec3 share{0}, shift{0}, deviation{0};
};

/// The average fibre at an inclination: forward (|phi| > pi/2: on through the hair) is the paper's a_f, alpha_f,
/// beta_f, backward its a_b, alpha_b, beta_b (equation 6); `error` is what the quadrature over theta_i estimates for
/// the two shares together.
struct AverageScattering {
  HalfScattering forward, backward;
  glm::dvec3 error{0};
};

/// Light that comes back after one or three backward scatterings among any number of forward ones: the paper's share
/// A_b = A_1 + A_3 (equations 11, 13, 14), mean shift Delta_b and deviation sigma_b.
struct MultipleBackscattering {
  glm::dvec3 attenuation{0}, shift{0}, deviation{0};
};

struct DualScatteringRow {
  double theta = 0;  ///< inclination of the viewer, theta_o [rad]
  AverageScattering average;
  MultipleBackscattering multiple;
};
/// Rows at even inclinations, the middles of equal parts of [-pi/2, pi/2].
struct DualScatteringTable {
  std::vector<DualScatteringRow> rows;
  /// Between the two rows about an inclination [rad] shares, shifts and variances are linear; beyond the first and the
  /// last row, these.
  DualScatteringRow at(double theta) const;
};

/// Average scattering of a model seen from theta_o in [-pi/2, pi/2]. Near-field models are averaged over 16 offsets,
/// elliptical ones are seen along their major axis. The quadrature over theta_i is adaptive to 1e-5 of the light; over
/// phi it has 96 points, so it suits lobes wider than 0.03 rad in theta_i and 0.1 rad in phi; there the two shares add
/// up to the albedo within 1e-4 (measured 3e-6, and 5e-5 with a caustic, dual_scattering_test). Error: bad_input, where
/// theta_o is outside its range.
Result<AverageScattering> average_scattering(const Model& model, const registry::ParameterValues& values,
                                             double theta_o);

/// The paper's sums. `density` is its d_b, 0.7 for human hair. A_b is within 1e-13 of its series; a fibre that sends
/// all light forward sends none back. Error: bad_input, where a forward share is 1 or more but the backward one is not
/// 0: the sums diverge.
Result<MultipleBackscattering> multiple_backscattering(const AverageScattering& average, double density = 0.7);

/// A table of `count` (1 .. 4096) rows. Errors: bad_input,
/// naming count, or theta where the sums diverge.
Result<DualScatteringTable> dual_scattering_terms(const Model& model, const registry::ParameterValues& values,
                                                  int count);

}  // namespace cuticle::bsdf
