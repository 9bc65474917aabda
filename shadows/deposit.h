#pragma once
// What a covered part of a texel adds to a map of integer sums.
#include <cstdint>
#include <vector>

namespace cuticle::shadows {

/// How optical depth is stored and averaged.
struct Accumulation {
  double k = 5.5;        ///< sigma = optical depth / k, T = exp(-k sigma)
  bool poisson = false;  ///< sum alpha c and average sigma; else sum -ln(1 - alpha c) and average T
};

/// Integers per unit of sigma: the largest power of two, 2^12 .. 2^20, at which `segments` crossings of opacity alpha
/// in one texel stay below 2^32.
double fixed_point_scale(double alpha, const Accumulation& accumulation, std::size_t segments);

/// What a covered fraction i / k_coverage_steps of a texel deposits, for i = 0 .. k_coverage_steps. An opaque crossing
/// counts as an optical depth of 16 ln 2, T = 2^-16.
std::vector<std::uint32_t> deposit_table(double alpha, const Accumulation& accumulation, double scale);

}  // namespace cuticle::shadows
