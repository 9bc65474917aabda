#include "lut/fit/positive_fit.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>
#include <fmt/format.h>

namespace cuticle::lut {

namespace {

constexpr double k_lowest_log = -9, k_highest_log = 6;

int numbers_of(std::span<const PositiveShape> shapes) {
  int numbers = 0;
  for (const PositiveShape& shape : shapes) numbers += shape.numbers();
  return numbers;
}

/// PositiveSmoothing as equations of logarithms.
struct Smoothing {
  std::vector<PositiveEquation> rows;

  Smoothing(std::span<const PositiveShape> shapes, const PositiveSmoothing& weights) {
    int first = 0;
    for (const PositiveShape& shape : shapes) {
      append(shape, first, weights);
      first += shape.numbers();
    }
  }

 private:
  void append(const PositiveShape& shape, int first, const PositiveSmoothing& weights) {
    const auto [bend, slope, pull] = weights;
    for (int place = 0; place < shape.pulled * shape.numbers_of_one(); ++place)
      rows.push_back({{{std::uint32_t(first + place), pull}}});
    const std::array<int, 3> stride{shape.rows[1] * shape.rows[2], shape.rows[2], 1};
    for (int place = 0; place < shape.numbers(); ++place)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int row = place / stride[axis] % shape.rows[axis];
        const auto at = [&](int k) { return std::uint32_t(first + place + k * stride[axis]); };
        if (row + 1 < shape.rows[axis]) rows.push_back({{{at(0), -slope}, {at(1), slope}}});
        if (row + 2 < shape.rows[axis]) rows.push_back({{{at(0), bend}, {at(1), -2 * bend}, {at(2), bend}}});
      }
  }
};

std::vector<double> exponentials(std::span<const double> logs) {
  std::vector<double> numbers;
  for (const double value : logs) numbers.push_back(std::exp(value));
  return numbers;
}

/// Weighted differences of all equations, then the smoothing; the parameters are logarithms.
class Differences : public ceres::CostFunction {
 public:
  Differences(std::span<const PositiveEquation> equations, const Smoothing& smoothing, int numbers)
      : equations_(equations), smoothing_(smoothing), numbers_(std::size_t(numbers)) {
    mutable_parameter_block_sizes()->push_back(numbers);
    set_num_residuals(int(equations.size() + smoothing.rows.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double* logs = parameters[0];
    double* slopes = jacobians ? jacobians[0] : nullptr;
    const std::vector<double> numbers = exponentials({logs, numbers_});
    if (slopes) std::fill_n(slopes, std::size_t(num_residuals()) * numbers_, 0.0);
    for (const PositiveEquation& equation : equations_) {
      *residuals = -equation.weight * equation.value;
      for (const auto& [place, factor, other] : equation.terms) {
        const bool two = other != PositiveEquation::k_none;
        const double part = equation.weight * factor * numbers[place] * (two ? numbers[other] : 1);
        *residuals += part;
        if (slopes) slopes[place] += part;
        if (slopes && two) slopes[other] += part;
      }
      ++residuals;
      if (slopes) slopes += numbers_;
    }
    for (const PositiveEquation& row : smoothing_.rows) {
      *residuals = 0;
      for (const auto& [place, factor, other] : row.terms) {
        *residuals += factor * logs[place];
        if (slopes) slopes[place] += factor;
      }
      ++residuals;
      if (slopes) slopes += numbers_;
    }
    return true;
  }

 private:
  std::span<const PositiveEquation> equations_;
  const Smoothing& smoothing_;
  std::size_t numbers_;
};

Result<void> check(std::span<const PositiveEquation> equations, int numbers) {
  for (std::size_t k = 0; k < equations.size(); ++k) {
    bool finite = std::isfinite(equations[k].value) && std::isfinite(equations[k].weight);
    for (const auto& [place, factor, other] : equations[k].terms) {
      for (const std::uint32_t at : {place, other == PositiveEquation::k_none ? place : other})
        if (at >= std::uint32_t(numbers))
          return bad_input(fmt::format("place {} lies outside the tables of {} numbers", at, numbers));
      finite = finite && std::isfinite(factor);
    }
    if (!finite) return bad_input(fmt::format("equation {} holds a number that is not finite", k));
  }
  return {};
}

double cost_of(std::span<const PositiveEquation> equations, std::span<const double> numbers) {
  double cost = 0;
  for (const PositiveEquation& equation : equations) {
    double sum = -equation.value;
    for (const auto& [place, factor, other] : equation.terms)
      sum += factor * numbers[place] * (other == PositiveEquation::k_none ? 1 : numbers[other]);
    cost += 0.5 * equation.weight * equation.weight * sum * sum;
  }
  return cost;
}

}  // namespace

Result<PositiveFit> fit_positive(std::span<const PositiveEquation> equations, std::span<const PositiveShape> shapes,
                                 const PositiveSmoothing& weights) {
  const int numbers = numbers_of(shapes);
  CUTICLE_TRY(check(equations, numbers));
  const Smoothing smoothing(shapes, weights);
  std::vector<double> logs(std::size_t(numbers), 0.0);
  ceres::Problem problem;
  problem.AddResidualBlock(new Differences(equations, smoothing, numbers), nullptr, logs.data());
  for (int k = 0; k < numbers; ++k) {
    problem.SetParameterLowerBound(logs.data(), k, k_lowest_log);
    problem.SetParameterUpperBound(logs.data(), k, k_highest_log);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return internal_error("least squares did not converge: " + summary.message);
  PositiveFit fit;
  fit.cost_before = cost_of(equations, std::vector<double>(logs.size(), 1.0));
  fit.numbers = exponentials(logs);
  fit.cost_after = cost_of(equations, fit.numbers);
  fit.steps = int(summary.iterations.size());
  return fit;
}

}  // namespace cuticle::lut
