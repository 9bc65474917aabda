#pragma once
// Tables of positive numbers from sums that hold them, as the corrections of dual scattering are found.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"

namespace cuticle::lut {

/// One equation: the sum of `factor` times the number at `place`, and times that at `other` where there is one, is
/// `value`; its difference counts `weight`.
struct PositiveEquation {
  static constexpr std::uint32_t k_none = 0xffffffffu;
  struct Term {
    std::uint32_t place;
    double factor;
    std::uint32_t other = k_none;
  };
  std::vector<Term> terms;
  double value = 0, weight = 1;
};

/// Tables of one shape behind each other, rows along three axes, the last one innermost. What equations do not say of
/// the first `pulled` of them lies near 1.
struct PositiveShape {
  int tables = 1;
  std::array<int, 3> rows{1, 1, 1};
  int pulled = 0;
  int numbers_of_one() const { return rows[0] * rows[1] * rows[2]; }
  int numbers() const { return tables * numbers_of_one(); }
};

struct PositiveFit {
  std::vector<double> numbers;
  double cost_before = 0, cost_after = 0;  ///< half the sum of squares, without smoothing
  int steps = 0;
};

/// What equations do not say: weights of second and first differences of the logarithms along the axes, and of the
/// logarithms themselves in pulled tables.
struct PositiveSmoothing {
  double bend = 0, slope = 0, pull = 0;
};

/// Least squares over the logarithms of the numbers, from 1, by Ceres; the tables of each shape stand behind those of
/// the one before. Errors: bad_input, naming the place outside the tables or the number of the equation that is not
/// finite; internal, where Ceres does not converge. Test: positive_fit_test.
Result<PositiveFit> fit_positive(std::span<const PositiveEquation> equations, std::span<const PositiveShape> shapes,
                                 const PositiveSmoothing& smoothing);

}  // namespace cuticle::lut
