// Least squares over the texels of a channel, with Ceres. The points between four texel centres filter the same four
// texels, so their squares add up to one quadratic form of four numbers: four residuals a cell stand for all its
// points.
#include <cmath>

#include <ceres/ceres.h>
#include <Eigen/Eigenvalues>

#include "core/expect.h"
#include "lut/fit/detail/texel_problem.h"

namespace cuticle::lut {
namespace {

/// Residuals r with |r|^2 = x' g x - 2 c' x + constant: along each eigenvector e of g, sqrt(l) (e'x - e'c / l).
class CellCost final : public ceres::SizedCostFunction<4, 1, 1, 1, 1> {
 public:
  explicit CellCost(const Cell& cell) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(cell.g);
    const double smallest = 1e-12 * solver.eigenvalues()[3];
    for (int k = 0; k < 4; ++k) {
      const double eigenvalue = solver.eigenvalues()[k];
      if (!(eigenvalue > smallest)) continue;
      rows_.row(k) = std::sqrt(eigenvalue) * solver.eigenvectors().col(k).transpose();
      aims_[k] = solver.eigenvectors().col(k).dot(cell.c) / std::sqrt(eigenvalue);
    }
  }
  bool Evaluate(const double* const* texels, double* residuals, double** jacobians) const override {
    const Eigen::Vector4d x(*texels[0], *texels[1], *texels[2], *texels[3]);
    Eigen::Map<Eigen::Vector4d>(residuals, 4) = rows_ * x - aims_;
    for (int corner = 0; jacobians && corner < 4; ++corner)
      if (jacobians[corner]) Eigen::Map<Eigen::Vector4d>(jacobians[corner], 4) = rows_.col(corner);
    return true;
  }

 private:
  Eigen::Matrix4d rows_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d aims_ = Eigen::Vector4d::Zero();
};

/// A linear problem: the first step is the optimum, and further ones only serve the bounds.
ceres::Solver::Options texel_solver_options() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.initial_trust_region_radius = options.max_trust_region_radius = 1e10;
  options.jacobi_scaling = false;
  options.function_tolerance = 1e-9;
  options.max_num_iterations = 50;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

std::vector<double> least_squares(const TexelProblem& problem, std::vector<double> texels) {
  ceres::Problem equations;
  for (std::size_t cell = 0; cell < problem.cells.size(); ++cell) {
    if (problem.cells[cell].g.isZero()) continue;
    double* corners[4];
    for (int corner = 0; corner < 4; ++corner) corners[corner] = &texels[problem.texel(cell, corner)];
    equations.AddResidualBlock(new CellCost(problem.cells[cell]), nullptr, corners[0], corners[1], corners[2],
                               corners[3]);
  }
  for (double& texel : texels)
    if (equations.HasParameterBlock(&texel)) equations.SetParameterLowerBound(&texel, 0, 0.0);
  ceres::Solver::Summary summary;
  ceres::Solve(texel_solver_options(), &equations, &summary);
  return texels;
}

}  // namespace cuticle::lut
