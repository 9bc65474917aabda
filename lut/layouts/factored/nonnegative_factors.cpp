#include "lut/layouts/factored/nonnegative_factors.h"

#include <algorithm>
#include <numeric>

namespace cuticle::lut::factored {
namespace {

constexpr int k_first_sweeps = 8;  ///< of the left side alone, which starts from nothing
constexpr int k_sweeps = 60;
constexpr double k_floor = 1e-300;  ///< keeps what divides above 0

double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// products[lobe][r] = row r of the matrix times the lobe's right vector.
Lobes times_right(const Matrix& matrix, const Lobes& right) {
  Lobes products;
  for (int k = 0; k < k_lobes; ++k)
    for (std::size_t r = 0; r < matrix.rows; ++r) products[k].push_back(dot(matrix.row(r), right[k]));
  return products;
}
Lobes times_left(const Matrix& matrix, const Lobes& left) {
  Lobes products;
  for (int k = 0; k < k_lobes; ++k) {
    products[k].assign(matrix.columns, 0.0);
    for (std::size_t r = 0; r < matrix.rows; ++r)
      for (std::size_t c = 0; c < matrix.columns; ++c) products[k][c] += left[k][r] * matrix.row(r)[c];
  }
  return products;
}

/// One sweep over the lobes of a side: each takes the best nonnegative value while the others stay.
void sweep(Lobes& side, const Lobes& products, const Lobes& other) {
  for (int k = 0; k < k_lobes; ++k) {
    std::array<double, k_lobes> overlap;
    for (int j = 0; j < k_lobes; ++j) overlap[j] = dot(other[k], other[j]);
    for (std::size_t i = 0; i < side[k].size(); ++i) {
      double rest = products[k][i];
      for (int j = 0; j < k_lobes; ++j)
        if (j != k) rest -= side[j][i] * overlap[j];
      side[k][i] = std::max(0.0, rest / std::max(overlap[k], k_floor));
    }
  }
}

/// Moves a lobe's size to the left, so that the right has mean 1.
void normalise(Factors& factors) {
  for (int k = 0; k < k_lobes; ++k) {
    std::vector<double>& right = factors.right[k];
    const double mean = std::accumulate(right.begin(), right.end(), 0.0) / double(right.size());
    const double size = mean > k_floor ? mean : 1;
    for (double& value : right) value = mean > k_floor ? value / size : 1;
    for (double& value : factors.left[k]) value = mean > k_floor ? value * size : 0;
  }
}

}  // namespace

Lobes distinct_rows(const Matrix& matrix) {
  Matrix rest = matrix;
  Lobes rows;
  for (std::vector<double>& chosen : rows) {
    std::size_t farthest = 0;
    for (std::size_t r = 1; r < rest.rows; ++r)
      if (dot(rest.row(r), rest.row(r)) > dot(rest.row(farthest), rest.row(farthest))) farthest = r;
    chosen.assign(matrix.row(farthest).begin(), matrix.row(farthest).end());
    const std::vector<double> direction(rest.row(farthest).begin(), rest.row(farthest).end());
    const double squared = std::max(dot(direction, direction), k_floor);
    for (std::size_t r = 0; r < rest.rows; ++r) {
      const double along = dot(rest.row(r), direction) / squared;
      for (std::size_t c = 0; c < rest.columns; ++c) rest.values[r * rest.columns + c] -= along * direction[c];
    }
  }
  return rows;
}

Factors nonnegative_factors(const Matrix& matrix, Lobes right) {
  Factors factors{{}, std::move(right)};
  for (std::vector<double>& left : factors.left) left.assign(matrix.rows, 0.0);
  const Lobes first = times_right(matrix, factors.right);
  for (int i = 0; i < k_first_sweeps; ++i) sweep(factors.left, first, factors.right);
  for (int i = 0; i < k_sweeps; ++i) {
    sweep(factors.right, times_left(matrix, factors.left), factors.left);
    sweep(factors.left, times_right(matrix, factors.right), factors.right);
  }
  normalise(factors);
  return factors;
}

}  // namespace cuticle::lut::factored
