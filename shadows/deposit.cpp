#include "shadows/deposit.h"

#include <algorithm>
#include <cmath>

#include "shadows/splat.glslh"

namespace cuticle::shadows {

namespace {

constexpr double k_opaque_depth = 11.090354888959125;  // 16 ln 2

double optical_depth(double alpha, double covered, bool poisson) {
  if (poisson) return alpha * covered;
  return std::min(k_opaque_depth, -std::log1p(-alpha * covered));
}

}  // namespace

double fixed_point_scale(double alpha, const Accumulation& accumulation, std::size_t segments) {
  const double crossing = optical_depth(alpha, 1, accumulation.poisson) / accumulation.k;
  const double most = double(std::max<std::size_t>(segments, 1)) * crossing;
  const double exponent = std::floor(std::log2(4294967295.0 / std::max(most, 1e-9)));
  return std::exp2(std::clamp(exponent, 12.0, 20.0));
}

std::vector<std::uint32_t> deposit_table(double alpha, const Accumulation& accumulation, double scale) {
  std::vector<std::uint32_t> table(k_coverage_steps + 1);
  for (std::uint32_t i = 0; i <= k_coverage_steps; ++i) {
    const double depth = optical_depth(alpha, double(i) / k_coverage_steps, accumulation.poisson);
    table[i] = std::uint32_t(std::lround(scale / accumulation.k * depth));
  }
  return table;
}

}  // namespace cuticle::shadows
