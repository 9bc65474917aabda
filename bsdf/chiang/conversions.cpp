#include "bsdf/chiang/conversions.h"

#include <cmath>
#include <numbers>

#include "bsdf/chiang/lobes.glslh"

namespace cuticle::bsdf::chiang {
namespace {

constexpr double smallest_beta = 1e-3;

/// Where a rising function of beta takes a value.
template <class Function>
double invert(const Function& function, double value) {
  double low = smallest_beta, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (function(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double deviation_from_beta_m(double beta_m) { return longitudinal_deviation(beta_m); }
double scale_from_beta_n(double beta_n) { return azimuthal_scale(beta_n); }
double beta_m_from_deviation(double deviation) { return invert(deviation_from_beta_m, deviation); }
double beta_n_from_scale(double scale) { return invert(scale_from_beta_n, scale); }
double scale_from_deviation(double deviation) { return deviation * std::numbers::sqrt3 / std::numbers::pi; }

}  // namespace cuticle::bsdf::chiang
