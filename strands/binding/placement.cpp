#include "strands/binding/placement.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/binding/nearest_triangle.h"

namespace cuticle::strands {

namespace {

/// Above the middle of all points, at the height of the highest.
glm::dvec3 top_of(std::span<const glm::vec3> points) {
  glm::dvec3 lower(points.front()), upper = lower;
  for (const glm::vec3& point : points) {
    lower = glm::min(lower, glm::dvec3(point));
    upper = glm::max(upper, glm::dvec3(point));
  }
  return {(lower.x + upper.x) / 2, upper.y, (lower.z + upper.z) / 2};
}

/// The uniform scale and shift that bring `from` nearest to `to`, point by point. Scale as it was where `from` is one
/// point.
Placement least_squares(std::span<const glm::vec3> from, std::span<const glm::dvec3> to, double scale) {
  glm::dvec3 mean_from{0}, mean_to{0};
  const auto count = double(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    mean_from += glm::dvec3(from[i]) / count;
    mean_to += to[i] / count;
  }
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const glm::dvec3 offset = glm::dvec3(from[i]) - mean_from;
    products += glm::dot(offset, to[i] - mean_to);
    squares += glm::dot(offset, offset);
  }
  Placement placement{squares > 0 && products > 0 ? products / squares : scale, glm::dvec3(0), 0};
  placement.shift = mean_to - placement.scale * mean_from;
  return placement;
}

}  // namespace

Result<Placement> fit_placement(std::span<const glm::vec3> roots, const Mesh& mesh, double first_scale) {
  const NearestTriangle nearest(mesh);
  if (nearest.empty()) return bad_input("growth mesh: no triangle has area, at least 1 is needed");
  if (roots.empty()) return bad_input("groom: no roots to place, at least 1 is needed");
  Placement placement{first_scale, top_of(mesh.positions) - first_scale * top_of(roots), 0};
  for (int step = 0; step < 60; ++step) {
    std::vector<glm::dvec3> targets;
    placement.mean_distance = 0;
    for (const glm::vec3& root : roots) {
      const MeshPoint found = nearest.at(placement.scale * glm::dvec3(root) + placement.shift);
      targets.push_back(found.point);
      placement.mean_distance += found.distance / double(roots.size());
    }
    const Placement better = least_squares(roots, targets, placement.scale);
    const double change = std::abs(better.scale / placement.scale - 1) + glm::distance(better.shift, placement.shift);
    if (change < 1e-6) break;
    placement.scale = better.scale;
    placement.shift = better.shift;
  }
  return placement;
}

void place(Groom& groom, const Placement& placement) {
  for (glm::vec3& point : groom.positions) point = glm::vec3(placement.scale * glm::dvec3(point) + placement.shift);
  for (float& radius : groom.radii) radius *= float(placement.scale);
}

}  // namespace cuticle::strands
