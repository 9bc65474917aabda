#include "lut/fit/detail/texel_problem.h"

#include <algorithm>
#include <cmath>

namespace cuticle::lut {
namespace {

/// A copy of the table whose texels hold their own column (or row), so that its filtered value is the position that the
/// filter reads at.
Table ramp_of(const Table& table, bool along_u) {
  Table ramp = table;
  const std::size_t stride = table.scale.size(), width = std::size_t(table.image.width);
  for (std::size_t i = 0; i < ramp.image.pixels.size(); ++i)
    ramp.image.pixels[i] = float(along_u ? i / stride % width : i / stride / width);
  std::fill(ramp.scale.begin(), ramp.scale.end(), 1.0);
  return ramp;
}

void add_position(FilterPositions& positions, double position, int size) {
  const int first = std::min(int(position), size - 2);
  positions.first.push_back(first);
  positions.part.push_back(position - first);
}

void add_to_cells(TexelProblem& problem) {
  problem.cells.resize(std::size_t(problem.size - 1) * std::size_t(problem.size - 1));
  for (std::size_t i = 0; i < problem.exact.size(); ++i) {
    if (!problem.counts(i)) continue;
    Cell& cell = problem.cells[problem.cell_of(i)];
    const Eigen::Vector4d weights = problem.weights(i);
    cell.g += weights * weights.transpose();
    cell.c += weights * problem.exact[i];
  }
}

}  // namespace

Eigen::Vector4d TexelProblem::weights(std::size_t i) const {
  const double x = u.part[i % u.first.size()], y = v.part[i / u.first.size()];
  return {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
}

TexelProblem make_problem(const Table& table, int channel, const ComparisonGrid& grid, const ExactValues& exact) {
  TexelProblem problem;
  problem.size = table.image.width;
  const Table columns = ramp_of(table, true), rows = ramp_of(table, false);
  for (int x = 0; x < grid.columns; ++x)
    add_position(problem.u, filtered_value(columns, channel, grid, std::size_t(x)), problem.size);
  for (int y = 0; y < grid.rows; ++y)
    add_position(problem.v, filtered_value(rows, channel, grid, std::size_t(y) * std::size_t(grid.columns)),
                 problem.size);
  const int component = table.layout->channels[std::size_t(channel)].component;
  for (const glm::dvec3& value : exact.values) problem.exact.push_back(value[component]);
  problem.left_out = exact.left_out;
  add_to_cells(problem);
  return problem;
}

double error_at(const TexelProblem& problem, std::span<const double> texels, std::size_t i) {
  const Eigen::Vector4d weights = problem.weights(i);
  const std::size_t cell = problem.cell_of(i);
  double value = 0;
  for (int corner = 0; corner < 4; ++corner) value += weights[corner] * texels[problem.texel(cell, corner)];
  return std::abs(value - problem.exact[i]);
}

double largest_error(const TexelProblem& problem, std::span<const double> texels) {
  double largest = 0;
  for (std::size_t i = 0; i < problem.exact.size(); ++i)
    if (problem.counts(i)) largest = std::max(largest, error_at(problem, texels, i));
  return largest;
}

Parabola along(const TexelProblem& problem, std::span<const double> texels, int column, int row) {
  Parabola sum;
  for (int corner = 0; corner < 4; ++corner) {
    const int x = column - corner % 2, y = row - corner / 2;
    if (x < 0 || y < 0 || x > problem.size - 2 || y > problem.size - 2) continue;
    const std::size_t cell = std::size_t(y) * std::size_t(problem.size - 1) + std::size_t(x);
    const Cell& terms = problem.cells[cell];
    sum.curvature += terms.g(corner, corner);
    sum.slope -= terms.c[corner];
    for (int k = 0; k < 4; ++k) sum.slope += terms.g(corner, k) * texels[problem.texel(cell, k)];
  }
  return sum;
}

bool keep_below(const TexelProblem& problem, std::span<const double> samples, double bound,
                std::vector<double>& texels) {
  for (bool changed = true; changed;) {
    changed = false;
    const std::vector<double> before = texels;
    for (std::size_t i = 0; i < problem.exact.size(); ++i) {
      if (!problem.counts(i) || error_at(problem, before, i) <= bound) continue;
      for (int corner = 0; corner < 4; ++corner) {
        const std::size_t texel = problem.texel(problem.cell_of(i), corner);
        changed |= texels[texel] != samples[texel];
        texels[texel] = samples[texel];
      }
    }
  }
  return largest_error(problem, texels) <= bound;
}

}  // namespace cuticle::lut
