#include "lut/layouts/factored/slices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace cuticle::lut::factored {
namespace {

constexpr double k_pi = std::numbers::pi;

double inclination(int texel, int size) { return (double(texel) / (size - 1) - 0.5) * k_pi; }

std::vector<bsdf::Point> points_of(std::span<const glm::ivec2> pairs, int size) {
  std::vector<bsdf::Point> points;
  points.reserve(pairs.size() * std::size_t(size) * k_points);
  for (const glm::ivec2& pair : pairs)
    for (int k = 0; k < size * k_points; ++k) {
      const double place = (k / k_points) - 0.5 + (k % k_points + 0.5) / k_points;
      bsdf::Point& at = points.emplace_back();
      at.theta_i = inclination(pair.x, size);
      at.theta_o = inclination(pair.y, size);
      at.phi = std::abs(place) * k_pi / (size - 1);
      if (at.phi > k_pi) at.phi = 2 * k_pi - at.phi;
    }
  return points;
}

/// The numbers of a slice in the texels of the tables: F at the pairs, G in the row of |theta_d|.
void store(TableSet& set, const Factors& factors, std::span<const glm::ivec2> pairs, int step) {
  Image& f = set.tables[0].image;
  for (int k = 0; k < k_lobes; ++k) {
    for (std::size_t r = 0; r < pairs.size(); ++r) f.at(pairs[r].x, pairs[r].y, k) = float(factors.left[k][r]);
    Image& g = set.tables[std::size_t(k) + 1].image;
    for (int column = 0; column < g.width * 3; ++column)
      g.at(column / 3, step, column % 3) = float(factors.right[k][std::size_t(column)]);
  }
}

bool is_zero(const Matrix& matrix) {
  return std::all_of(matrix.values.begin(), matrix.values.end(), [](double value) { return value == 0; });
}

}  // namespace

std::vector<glm::ivec2> diagonal(int size, int step) {
  std::vector<glm::ivec2> pairs;
  for (int i = 0; i + step < size; ++i) {
    pairs.emplace_back(i, i + step);
    if (step > 0) pairs.emplace_back(i + step, i);
  }
  return pairs;
}

Result<Matrix> slice(const Source& source, int size, int step) {
  const std::vector<glm::ivec2> pairs = diagonal(size, step);
  const std::vector<bsdf::Point> points = points_of(pairs, size);
  std::vector<glm::dvec3> values(points.size());
  CUTICLE_TRY(source.many()({bsdf::Quantity::S, -1, points}, values));
  Matrix matrix{pairs.size(), std::size_t(size) * 3, {}};
  matrix.values.assign(matrix.rows * matrix.columns, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(values[i][c]) || values[i][c] < 0)
        return internal_error(fmt::format("{}: S is {} at theta_i {}, theta_o {}, phi {}; factors need 0 or more",
                                          source.model->entry.name, values[i][c], points[i].theta_i, points[i].theta_o,
                                          points[i].phi));
      matrix.values[i / k_points * 3 + std::size_t(c)] += values[i][c] / k_points;
    }
  return matrix;
}

Result<void> solve(const Source& source, TableSet& set, Progress& progress) {
  Lobes right;
  bool nothing = true;
  for (int step = 0; step < set.size; ++step) {
    progress.update("factorise", std::size_t(step), std::size_t(set.size));
    CUTICLE_ASSIGN(const Matrix matrix, slice(source, set.size, step));
    const bool empty = is_zero(matrix);
    if (nothing && !empty) right = distinct_rows(matrix);
    nothing = nothing && empty;
    if (nothing) continue;
    const Factors factors = nonnegative_factors(matrix, right);
    store(set, factors, diagonal(set.size, step), step);
    if (!empty) right = factors.right;
  }
  progress.update("factorise", std::size_t(set.size), std::size_t(set.size));
  if (!nothing) return {};
  return usage_error(fmt::format("{}: S is 0 everywhere, which has no factors", source.model->entry.name),
                     "choose other parameters");
}

}  // namespace cuticle::lut::factored
