#pragma once
// Distance to a closed mesh from the tangent plane of its nearest vertex.
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "strands/mesh.h"

namespace cuticle::strands {

/// Where a point stands to a surface: signed distance (negative inside), metres, and the outward normal.
struct SurfaceHit {
  double distance = 1;
  glm::dvec3 normal{0, 1, 0};
};

/// Vertices of a mesh in a grid of cells. Beyond `reach` of every vertex the distance is just given as `reach`.
class NearestSurface {
 public:
  NearestSurface(const Mesh& mesh, double reach);
  SurfaceHit at(const glm::dvec3& point) const;

 private:
  static constexpr int k_cells_per_reach = 5;
  glm::ivec3 cell_of(const glm::dvec3& point) const;
  std::size_t place_of(const glm::ivec3& cell) const;
  void find_gaps();
  /// No vertex lies in a cell at a smaller Chebyshev distance.
  int first_ring(const glm::ivec3& center) const;
  /// Visits the cells at Chebyshev distance `ring`; updates the nearest vertex and its squared distance.
  void search_ring(const glm::dvec3& point, const glm::ivec3& center, int ring, double& squared,
                   std::uint32_t& vertex) const;

  const Mesh& mesh_;
  double reach_, cell_;
  glm::dvec3 lower_{0};
  glm::ivec3 size_{0};
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<int> gaps_;  ///< of each cell: Chebyshev distance to the nearest that has vertices
};

}  // namespace cuticle::strands
