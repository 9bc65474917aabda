#pragma once
// Chiang's parameters to and from those of other renderers and of measurements. Angles in radians.
namespace cuticle::bsdf::chiang {

/// `alpha` here: positive where the scales lean to the tip, with u from root to tip; R peaks at theta_i + theta_o = -2
/// alpha. pbrt-v4, and pbrt-v3 since its pull request 256 (2019), tilt theta_o by -2 alpha for R, so that it peaks at
/// +2 alpha: the opposite sign.
constexpr double alpha_from_pbrt(double alpha) { return -alpha; }
constexpr double alpha_to_pbrt(double alpha) { return -alpha; }
/// Tungsten (HairBcsdf) tilts theta_o by -2 scale_angle for R: the opposite sign.
constexpr double alpha_from_tungsten(double scale_angle) { return -scale_angle; }
constexpr double alpha_to_tungsten(double alpha) { return -alpha; }
/// pbrt-v3 before its pull request 256 tilted theta_i by +2 alpha for R, which peaks at -2 alpha: the sign here.
constexpr double alpha_from_pbrt_before_2019(double alpha) { return alpha; }

/// `h` here: the viewer's ray meets the fibre at azimuth phi_o + asin h. pbrt measures phi as phi_i - phi_o, which
/// mirrors it.
constexpr double offset_from_pbrt(double h) { return -h; }
constexpr double offset_to_pbrt(double h) { return -h; }

/// Standard deviation of the R lobe in theta_i [rad] (the root of the paper's v) from beta_m in [0, 1], and of the
/// azimuthal logistic's scale s [rad] from beta_n in [0, 1]: the paper's polynomials.
double deviation_from_beta_m(double beta_m);
double scale_from_beta_n(double beta_n);
/// Their inverses by bisection, to 1e-15; arguments beyond the range of beta in [0.001, 1] give its ends.
double beta_m_from_deviation(double deviation);
double beta_n_from_scale(double scale);
/// The logistic distribution's scale from its standard deviation [rad], which is s pi / sqrt 3 (before it is cut to one
/// turn).
double scale_from_deviation(double deviation);

}  // namespace cuticle::bsdf::chiang
