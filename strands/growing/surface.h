#pragma once
// Distance to a closed mesh from the tangent plane of its nearest vertex.
#include <array>
#include <map>
#include <vector>

#include <glm/vec3.hpp>

#include <cuticle/strands/mesh.h>

namespace cuticle::strands {

/// Where a point stands to a surface: signed distance (negative inside), metres, and the outward normal.
struct SurfaceHit {
  double distance = 1;
  glm::dvec3 normal{0, 1, 0};
};

/// Vertices of a mesh in a grid. Beyond `reach` of every vertex the distance is just given as `reach`.
class NearestSurface {
 public:
  NearestSurface(const Mesh& mesh, double reach);
  SurfaceHit at(const glm::dvec3& point) const;

 private:
  using Cell = std::array<int, 3>;
  Cell cell_of(const glm::dvec3& point) const;

  const Mesh& mesh_;
  double reach_;
  std::map<Cell, std::vector<std::uint32_t>> vertices_;
};

}  // namespace cuticle::strands
