#pragma once
// What the derivatives at a fit's end say: standard deviations, correlations, and what cannot be told apart. Private to
// lut/fit.
#include <span>

#include "lut/fit/detail/tangents.h"

namespace cuticle::lut {

/// Where the robust losses begin, in standard deviations: 95 % efficient where the noise is Gaussian.
inline constexpr double k_huber_at = 1.345, k_cauchy_at = 2.385;

/// Standard deviation of the noise that residuals show, for `parameters` fitted to them; with a robust loss Huber's
/// estimate for the covariance (sum psi^2 / (n - p)) / (mean psi')^2.
double robust_noise(std::span<const double> residuals, std::size_t parameters, Loss loss);

/// Fills parameters, correlations and inseparable groups. `gradients`: derivatives of the residuals, number by number;
/// `noise`: standard deviation of the residuals.
void describe(const std::vector<FreeParameter>& free, std::span<const double> x, std::span<const double> gradients,
              double noise, ModelFit& fit);

}  // namespace cuticle::lut
