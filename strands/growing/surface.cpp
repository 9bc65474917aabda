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
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) cells_[place_of(cell_of(mesh.positions[v]))].push_back(v);
  find_gaps();
}

std::size_t NearestSurface::place_of(const glm::ivec3& cell) const {
  return std::size_t((cell.z * size_.y + cell.y) * size_.x + cell.x);
}

/// Forwards and backwards over the cells, each from the neighbours that were visited (Rosenfeld and Pfaltz 1966).
void NearestSurface::find_gaps() {
  gaps_.resize(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) gaps_[i] = cells_[i].empty() ? size_.x + size_.y + size_.z : 0;
  const auto lower = [&](int x, int y, int z) {
    int& gap = gaps_[place_of({x, y, z})];
    const glm::ivec3 low = glm::max(glm::ivec3(x, y, z) - 1, 0), high = glm::min(glm::ivec3(x, y, z) + 1, size_ - 1);
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i) gap = std::min(gap, gaps_[place_of({i, j, k})] + 1);
  };
  for (int z = 0; z < size_.z; ++z)
    for (int y = 0; y < size_.y; ++y)
      for (int x = 0; x < size_.x; ++x) lower(x, y, z);
  for (int z = size_.z - 1; z >= 0; --z)
    for (int y = size_.y - 1; y >= 0; --y)
      for (int x = size_.x - 1; x >= 0; --x) lower(x, y, z);
}

glm::ivec3 NearestSurface::cell_of(const glm::dvec3& point) const {
  return glm::ivec3(glm::clamp(glm::floor((point - lower_) / cell_), -1e6, 1e6));
}

int NearestSurface::first_ring(const glm::ivec3& center) const {
  const glm::ivec3 inside = glm::clamp(center, glm::ivec3(0), size_ - 1), away = glm::abs(center - inside);
  const int outside = std::max({away.x, away.y, away.z});
  return std::max(outside, gaps_[place_of(inside)] - outside);
}

void NearestSurface::search_ring(const glm::dvec3& point, const glm::ivec3& center, int ring, double& squared,
                                 std::uint32_t& vertex) const {
  const glm::ivec3 low = glm::max(center - ring, 0), high = glm::min(center + ring, size_ - 1);
  if (low.x > high.x) return;
  const auto search = [&](const glm::ivec3& cell) {
    for (std::uint32_t v : cells_[place_of(cell)]) {
      const glm::dvec3 offset = point - glm::dvec3(mesh_.positions[v]);
      if (glm::dot(offset, offset) >= squared) continue;
      squared = glm::dot(offset, offset);
      vertex = v;
    }
  };
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y) {
      if (std::abs(z - center.z) == ring || std::abs(y - center.y) == ring) {
        for (int x = low.x; x <= high.x; ++x) search({x, y, z});
        continue;
      }
      if (center.x - ring == low.x) search({low.x, y, z});
      if (center.x + ring == high.x) search({high.x, y, z});
    }
}

SurfaceHit NearestSurface::at(const glm::dvec3& point) const {
  const glm::ivec3 center = cell_of(point);
  double squared = reach_ * reach_;
  std::uint32_t vertex = std::uint32_t(mesh_.positions.size());
  // What lies in ring r is at least r - 1 cells away.
  for (int ring = cells_.empty() ? 0 : first_ring(center); (ring - 1) * cell_ < std::sqrt(squared); ++ring)
    search_ring(point, center, ring, squared, vertex);
  if (vertex == mesh_.positions.size()) return {reach_, {0, 1, 0}};
  const glm::dvec3 normal(mesh_.normals[vertex]);
  return {glm::dot(point - glm::dvec3(mesh_.positions[vertex]), normal), normal};
}

}  // namespace cuticle::strands
