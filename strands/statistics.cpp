#include "strands/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

constexpr double k_cells_per_side = 48;

double largest_side(const Bounds& box) {
  const glm::dvec3 side = glm::dvec3(box.upper) - glm::dvec3(box.lower);
  return std::max({side.x, side.y, side.z});
}

using Cells = std::map<std::array<int, 3>, double>;

/// Adds a segment's length to the cells that it passes, in pieces no longer than half a cell.
void deposit(Cells& cells, const glm::dvec3& a, const glm::dvec3& b, double cell) {
  const double length = glm::distance(a, b);
  const int pieces = 1 + int(length / (0.5 * cell));
  for (int i = 0; i < pieces; ++i) {
    const glm::dvec3 place = glm::floor(glm::mix(a, b, (i + 0.5) / pieces) / cell);
    cells[{int(place.x), int(place.y), int(place.z)}] += length / pieces;
  }
}

double fibre_spacing(const Groom& groom, const Bounds& box) {
  const double cell = largest_side(box) / k_cells_per_side;
  if (!(cell > 0)) return 0;
  Cells cells;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const auto points = groom.strand(s);
    for (std::size_t i = 1; i < points.size(); ++i)
      deposit(cells, glm::dvec3(points[i - 1]) - glm::dvec3(box.lower), glm::dvec3(points[i]) - glm::dvec3(box.lower),
              cell);
  }
  std::vector<double> densities;
  for (const auto& [place, length] : cells)
    if (length > 0) densities.push_back(length / (cell * cell * cell));
  return densities.empty() ? 0 : 1 / std::sqrt(spread(std::move(densities)).median);
}

}  // namespace

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {values.front(), values[values.size() / 2], sum / double(values.size()), values.back()};
}

GroomStatistics statistics(const Groom& groom) {
  GroomStatistics result;
  result.strands = groom.strand_count();
  result.vertices = groom.vertex_count();
  result.bounds = bounds(groom);
  result.least_vertices = groom.vertex_count();
  std::vector<double> lengths, segments;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const auto points = groom.strand(s);
    result.least_vertices = std::min(result.least_vertices, points.size());
    result.greatest_vertices = std::max(result.greatest_vertices, points.size());
    lengths.push_back(strand_length(groom, s));
    std::size_t coincident = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      segments.push_back(glm::distance(glm::dvec3(points[i - 1]), glm::dvec3(points[i])));
      coincident += segments.back() == 0;
    }
    if (coincident > 0 || lengths.back() == 0) result.degenerate.push_back({s, coincident, lengths.back() > 0});
  }
  result.length = spread(std::move(lengths));
  result.segment = spread(std::move(segments));
  result.radius = spread({groom.radii.begin(), groom.radii.end()});
  result.spacing = fibre_spacing(groom, result.bounds);
  return result;
}

}  // namespace cuticle::strands
