#include "lut/fit/detail/identify.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace cuticle::lut {
namespace {

constexpr double k_no_influence = 1e-9;  ///< of the strongest parameter's, each over its whole range
constexpr double k_singular = 1e-12;     ///< eigenvalue of the normal matrix with ones on its diagonal
constexpr double k_named = 0.1;          ///< share of a direction's largest component from which a parameter is named

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Matrix normal_matrix(std::span<const double> gradients, std::size_t parameters) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> jacobian(gradients.data(), Eigen::Index(gradients.size() / parameters),
                                            Eigen::Index(parameters));
  return jacobian.transpose() * jacobian;
}

/// The rows and columns of `kept` with ones on the diagonal, and the square roots that were divided by.
struct Scaled {
  std::vector<Eigen::Index> kept;
  Matrix matrix;
  Vector roots;
};
Scaled scaled(const Matrix& normal, std::vector<Eigen::Index> kept) {
  const Eigen::Index count = Eigen::Index(kept.size());
  Scaled result{std::move(kept), Matrix(count, count), Vector(count)};
  for (Eigen::Index i = 0; i < count; ++i)
    result.roots[i] = std::sqrt(normal(result.kept[std::size_t(i)], result.kept[std::size_t(i)]));
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      result.matrix(i, j) =
          normal(result.kept[std::size_t(i)], result.kept[std::size_t(j)]) / (result.roots[i] * result.roots[j]);
  return result;
}

/// How far each residual-weighted parameter moves the data over its whole range.
Vector influences(const Matrix& normal, const std::vector<FreeParameter>& free) {
  Vector influence(normal.rows());
  for (Eigen::Index j = 0; j < normal.rows(); ++j)
    influence[j] = std::sqrt(normal(j, j)) * free[std::size_t(j)].range();
  return influence;
}

/// Whether one standard deviation along the direction takes a parameter through half of its range.
bool is_loose(const Scaled& s, const Vector& direction, double deviation, const std::vector<FreeParameter>& free) {
  for (Eigen::Index i = 0; i < direction.size(); ++i)
    if (deviation * std::abs(direction[i]) / s.roots[i] > free[std::size_t(s.kept[std::size_t(i)])].range() / 2)
      return true;
  return false;
}

std::vector<std::string> names_along(const Scaled& s, const Vector& direction, const std::vector<FreeParameter>& free) {
  std::vector<std::string> names;
  const double named = k_named * direction.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < direction.size(); ++i)
    if (std::abs(direction[i]) >= named) names.push_back(free[std::size_t(s.kept[std::size_t(i)])].name);
  return names;
}

/// Directions in which the data do not hold the parameters: names of those that each involves.
void find_loose_directions(const Scaled& s, double noise, const std::vector<FreeParameter>& free, ModelFit& fit) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(s.matrix);
  for (Eigen::Index k = 0; k < s.matrix.rows(); ++k) {
    const double eigenvalue = solver.eigenvalues()[k];
    const Vector direction = solver.eigenvectors().col(k);
    if (eigenvalue < k_singular || is_loose(s, direction, noise / std::sqrt(eigenvalue), free))
      fit.inseparable.push_back(names_along(s, direction, free));
  }
}

/// Whether a parameter ends at a bound, toward which the data still pull.
bool at_bound(const FreeParameter& free, double x) {
  const double close = 1e-9 * free.range();
  return x - free.parameter->minimum <= close || free.parameter->maximum - x <= close;
}

void fill_covariance(const Scaled& s, double noise, ModelFit& fit) {
  const Matrix inverse = s.matrix.ldlt().solve(Matrix::Identity(s.matrix.rows(), s.matrix.cols()));
  const std::size_t all = fit.parameters.size();
  for (Eigen::Index i = 0; i < inverse.rows(); ++i) {
    const std::size_t row = std::size_t(s.kept[std::size_t(i)]);
    fit.parameters[row].sigma = noise * std::sqrt(inverse(i, i)) / s.roots[i];
    for (Eigen::Index j = 0; j < inverse.cols(); ++j)
      fit.correlations[row * all + std::size_t(s.kept[std::size_t(j)])] =
          inverse(i, j) / std::sqrt(inverse(i, i) * inverse(j, j));
  }
}

}  // namespace

double robust_noise(std::span<const double> residuals, std::size_t parameters, Loss loss) {
  const double n = double(residuals.size());
  double squares = 0, slopes = 0;
  for (double r : residuals) {
    const double size = std::abs(r), ratio = r / k_cauchy_at, curve = 1 + ratio * ratio;
    const bool inside = loss == Loss::squares || size <= k_huber_at;
    const double psi = loss == Loss::cauchy ? r / curve : inside ? size : k_huber_at;
    squares += psi * psi;
    slopes += loss == Loss::cauchy ? (1 - ratio * ratio) / (curve * curve) : inside ? 1 : 0;
  }
  return std::sqrt(squares / (n - double(parameters))) / (slopes / n);
}

void describe(const std::vector<FreeParameter>& free, std::span<const double> x, std::span<const double> gradients,
              double noise, ModelFit& fit) {
  const Matrix normal = normal_matrix(gradients, free.size());
  const Vector influence = influences(normal, free);
  const double weak = k_no_influence * influence.maxCoeff();
  std::vector<Eigen::Index> felt, inside;
  for (std::size_t j = 0; j < free.size(); ++j) {
    fit.parameters.push_back({free[j].name, x[j], 0, at_bound(free[j], x[j])});
    const Eigen::Index index = Eigen::Index(j);
    if (!(influence[index] > weak)) {
      fit.inseparable.push_back({free[j].name});
      continue;
    }
    felt.push_back(index);
    if (!fit.parameters[j].at_bound) inside.push_back(index);
  }
  fit.correlations.assign(free.size() * free.size(), 0.0);
  if (!felt.empty()) find_loose_directions(scaled(normal, felt), noise, free, fit);
  if (fit.inseparable.empty() && !inside.empty()) fill_covariance(scaled(normal, inside), noise, fit);
}

}  // namespace cuticle::lut
