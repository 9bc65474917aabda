#pragma once
// A matrix as a sum of a few products of nonnegative vectors, by alternating least squares.
#include <array>
#include <span>
#include <vector>

namespace cuticle::lut::factored {

inline constexpr int k_lobes = 3;
using Lobes = std::array<std::vector<double>, k_lobes>;

/// A matrix, row after row.
struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
  std::span<const double> row(std::size_t r) const { return std::span(values).subspan(r * columns, columns); }
};
/// values(r, c) = sum over lobes of left[lobe][r] right[lobe][c].
struct Factors {
  Lobes left, right;
};

/// Rows of the matrix that are far from each other's combinations (successive projection, Araujo et al. 2001).
Lobes distinct_rows(const Matrix& matrix);

/// Least squares by hierarchical alternating updates (Cichocki, Zdunek and Amari 2007), 60 sweeps from `right`; every
/// right vector has mean 1. All values must be finite and not negative. A lobe that vanishes is 0 on the left.
/// Measured: an exact sum of products is met within 1e-3 of its rms (lut_factored_test).
Factors nonnegative_factors(const Matrix& matrix, Lobes right);

}  // namespace cuticle::lut::factored
