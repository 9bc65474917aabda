#include "strands/growing/surface.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::strands {

NearestSurface::NearestSurface(const Mesh& mesh, double reach)
    : mesh_(mesh), reach_(reach), cell_(reach / k_cells_per_reach) {
  if (mesh.positions.empty()) return;
  glm::dvec3 upper(mesh.positions.front());
  lower_ = upper;
  for (const glm::vec3& position : mesh.positions) {
    lower_ = glm::min(lower_, glm::dvec3(position));
    upper = glm::max(upper, glm::dvec3(position));
  }
  // At most 64 cells a side, so that a far-off vertex cannot make the grid huge.
  const glm::dvec3 side = upper - lower_;
  cell_ = std::max(cell_, std::max({side.x, side.y, side.z}) / 64);
  size_ = cell_of(upper) + 1;
  cells_.resize(std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(size_.z));
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::ivec3 cell = cell_of(mesh.positions[v]);
    cells_[std::size_t((cell.z * size_.y + cell.y) * size_.x + cell.x)].push_back(v);
  }
}

glm::ivec3 NearestSurface::cell_of(const glm::dvec3& point) const {
  return glm::ivec3(glm::clamp(glm::floor((point - lower_) / cell_), -1e6, 1e6));
}

const std::vector<std::uint32_t>* NearestSurface::vertices_in(const glm::ivec3& cell) const {
  for (int axis = 0; axis < 3; ++axis)
    if (cell[axis] < 0 || cell[axis] >= size_[axis]) return nullptr;
  return &cells_[std::size_t((cell.z * size_.y + cell.y) * size_.x + cell.x)];
}

void NearestSurface::search_ring(const glm::dvec3& point, const glm::ivec3& center, int ring, double& squared,
                                 std::uint32_t& vertex) const {
  for (int z = -ring; z <= ring; ++z)
    for (int y = -ring; y <= ring; ++y) {
      const bool is_face = std::abs(z) == ring || std::abs(y) == ring;
      for (int x = -ring; x <= ring; x += is_face || ring == 0 ? 1 : 2 * ring) {
        const auto* vertices = vertices_in(center + glm::ivec3(x, y, z));
        if (!vertices) continue;
        for (std::uint32_t v : *vertices) {
          const glm::dvec3 offset = point - glm::dvec3(mesh_.positions[v]);
          if (glm::dot(offset, offset) >= squared) continue;
          squared = glm::dot(offset, offset);
          vertex = v;
        }
      }
    }
}

SurfaceHit NearestSurface::at(const glm::dvec3& point) const {
  const glm::ivec3 center = cell_of(point);
  double squared = reach_ * reach_;
  std::uint32_t vertex = std::uint32_t(mesh_.positions.size());
  // What lies in ring r is at least r - 1 cells away.
  for (int ring = 0; (ring - 1) * cell_ < std::sqrt(squared); ++ring) search_ring(point, center, ring, squared, vertex);
  if (vertex == mesh_.positions.size()) return {reach_, {0, 1, 0}};
  const glm::dvec3 normal(mesh_.normals[vertex]);
  return {glm::dot(point - glm::dvec3(mesh_.positions[vertex]), normal), normal};
}

}  // namespace cuticle::strands
