#include "lut/fit/positive_fit.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>
#include <fmt/format.h>

namespace cuticle::lut {

namespace {

constexpr double k_lowest_log = -9, k_highest_log = 6;

/// PositiveSmoothing as equations of logarithms.
struct Smoothing {
  std::vector<PositiveEquation> rows;

  Smoothing(const PositiveShape& shape, const PositiveSmoothing& weights) {
    const auto [bend, slope, pull, pulled] = weights;
    for (int place = 0; place < pulled * shape.numbers() / shape.tables; ++place)
      rows.push_back({{{std::uint32_t(place), pull}}});
    const std::array<int, 3> stride{shape.rows[1] * shape.rows[2], shape.rows[2], 1};
    for (int place = 0; place < shape.numbers(); ++place)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int row = place / stride[axis] % shape.rows[axis];
        const auto at = [&](int k) { return std::uint32_t(place + k * stride[axis]); };
        if (row + 1 < shape.rows[axis]) rows.push_back({{{at(0), -slope}, {at(1), slope}}});
        if (row + 2 < shape.rows[axis]) rows.push_back({{{at(0), bend}, {at(1), -2 * bend}, {at(2), bend}}});
      }
  }
};

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
    if (slopes) std::fill_n(slopes, std::size_t(num_residuals()) * numbers_, 0.0);
    for (const PositiveEquation& equation : equations_) {
      *residuals = -equation.weight * equation.value;
      for (const auto& [place, factor] : equation.terms) {
        const double part = equation.weight * factor * std::exp(logs[place]);
        *residuals += part;
        if (slopes) slopes[place] += part;
      }
      ++residuals;
      if (slopes) slopes += numbers_;
    }
    for (const PositiveEquation& row : smoothing_.rows) {
      *residuals = 0;
      for (const auto& [place, factor] : row.terms) {
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

Result<void> check(std::span<const PositiveEquation> equations, const PositiveShape& shape) {
  for (std::size_t k = 0; k < equations.size(); ++k) {
    bool finite = std::isfinite(equations[k].value) && std::isfinite(equations[k].weight);
    for (const auto& [place, factor] : equations[k].terms) {
      if (int(place) >= shape.numbers())
        return bad_input(fmt::format("place {} lies outside the table of {} numbers", place, shape.numbers()));
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
    for (const auto& [place, factor] : equation.terms) sum += factor * numbers[place];
    cost += 0.5 * equation.weight * equation.weight * sum * sum;
  }
  return cost;
}

}  // namespace

Result<PositiveFit> fit_positive(std::span<const PositiveEquation> equations, const PositiveShape& shape,
                                 const PositiveSmoothing& weights) {
  CUTICLE_TRY(check(equations, shape));
  const Smoothing smoothing(shape, weights);
  std::vector<double> logs(std::size_t(shape.numbers()), 0.0);
  ceres::Problem problem;
  problem.AddResidualBlock(new Differences(equations, smoothing, shape.numbers()), nullptr, logs.data());
  for (int k = 0; k < shape.numbers(); ++k) {
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
  for (const double value : logs) fit.numbers.push_back(std::exp(value));
  fit.cost_after = cost_of(equations, fit.numbers);
  fit.steps = int(summary.iterations.size());
  return fit;
}

}  // namespace cuticle::lut
