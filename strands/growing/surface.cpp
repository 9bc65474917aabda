#include <cuticle/strands/growing/surface.h>

#include <cmath>

#include <glm/geometric.hpp>

namespace cuticle::strands {

NearestSurface::NearestSurface(const Mesh& mesh, double reach) : mesh_(mesh), reach_(reach) {
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) vertices_[cell_of(mesh.positions[v])].push_back(v);
}

NearestSurface::Cell NearestSurface::cell_of(const glm::dvec3& point) const {
  return {int(std::floor(point.x / reach_)), int(std::floor(point.y / reach_)), int(std::floor(point.z / reach_))};
}

SurfaceHit NearestSurface::at(const glm::dvec3& point) const {
  const Cell center = cell_of(point);
  double nearest = reach_ * reach_;
  SurfaceHit hit{reach_, {0, 1, 0}};
  for (int i = 0; i < 27; ++i) {
    const auto cell = vertices_.find({center[0] + i % 3 - 1, center[1] + i / 3 % 3 - 1, center[2] + i / 9 - 1});
    if (cell == vertices_.end()) continue;
    for (std::uint32_t v : cell->second) {
      const glm::dvec3 offset = point - glm::dvec3(mesh_.positions[v]);
      const double squared = glm::dot(offset, offset);
      if (squared >= nearest) continue;
      nearest = squared;
      const glm::dvec3 normal(mesh_.normals[v]);
      hit = {glm::dot(offset, normal), normal};
    }
  }
  return hit;
}

}  // namespace cuticle::strands
