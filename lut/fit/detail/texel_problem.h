#pragma once
// One channel of one table as a least-squares problem. Private to lut/fit.
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lut/comparison.h"

namespace cuticle::lut {

/// For each line of the comparison's grid along an axis: the first of the two texels that it filters, and the second's
/// part. A bin's mean keeps to one pair of texels, because bins end at texel centres and borders.
struct FilterPositions {
  std::vector<int> first;
  std::vector<double> part;
};

/// The texels between four neighbouring texel centres: the sum of squares of its points, x' g x - 2 c' x, for the
/// texels (0, 0), (1, 0), (0, 1), (1, 1).
struct Cell {
  Eigen::Matrix4d g = Eigen::Matrix4d::Zero();
  Eigen::Vector4d c = Eigen::Vector4d::Zero();
};

struct TexelProblem {
  int size = 0;
  FilterPositions u, v;
  std::vector<double> exact;           ///< row by row of the grid
  std::vector<std::uint8_t> left_out;  ///< empty: none
  std::vector<Cell> cells;             ///< (size - 1)^2, row by row

  bool counts(std::size_t i) const { return left_out.empty() || !left_out[i]; }
  /// Index of corner 0 .. 3 of a cell.
  std::size_t texel(std::size_t cell, int corner) const {
    const std::size_t row = cell / std::size_t(size - 1), column = cell % std::size_t(size - 1);
    return (row + std::size_t(corner / 2)) * std::size_t(size) + column + std::size_t(corner % 2);
  }
  std::size_t cell_of(std::size_t i) const {
    const std::size_t columns = u.first.size();
    return std::size_t(v.first[i / columns]) * std::size_t(size - 1) + std::size_t(u.first[i % columns]);
  }
  Eigen::Vector4d weights(std::size_t i) const;
};

/// The problem of a channel; the table says how it is filtered, its numbers do not matter.
TexelProblem make_problem(const Table& table, int channel, const ComparisonGrid& grid, const ExactValues& exact);
/// Absolute error of the filtered texels at a point of the grid.
double error_at(const TexelProblem& problem, std::span<const double> texels, std::size_t i);
double largest_error(const TexelProblem& problem, std::span<const double> texels);
/// The curvature of the squared error along one texel, and half its slope.
struct Parabola {
  double curvature = 0, slope = 0;
};
Parabola along(const TexelProblem& problem, std::span<const double> texels, int column, int row);

/// The texels >= 0 of least squared error, from `start`; those that no point filters stay as they are.
std::vector<double> least_squares(const TexelProblem& problem, std::vector<double> start);
/// `texels` = numbers that `round` returns, times `scale`, changed one by one to the best such number for their
/// neighbours until none changes.
void round_with_neighbours(const TexelProblem& problem, double (*round)(double), double scale, double largest,
                           std::vector<double>& texels);
/// Puts samples back in place of fitted texels wherever an error passes `bound`, until none does. False: it still does
/// somewhere, with samples all around.
bool keep_below(const TexelProblem& problem, std::span<const double> samples, double bound,
                std::vector<double>& texels);

}  // namespace cuticle::lut
