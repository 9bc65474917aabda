#pragma once
// The point of a mesh that is nearest to a given one.
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

#include "strands/mesh.h"

namespace cuticle::strands {

/// A point of a mesh: weights of the triangle's corners, each at least 0, of sum 1.
struct MeshPoint {
  std::uint32_t triangle = 0;
  glm::dvec3 weights{1, 0, 0};
  glm::dvec3 point{0};
  double distance = std::numeric_limits<double>::infinity();
};

/// The point of one triangle nearest to p (Ericson 2005, Real-Time Collision Detection, 5.1.5); exact in double but for
/// rounding. A triangle without area gives the nearest point of its longest edge.
MeshPoint nearest_on_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p);

/// Triangles with area, in a tree of boxes. The mesh must stay as it is while this lives.
class NearestTriangle {
 public:
  explicit NearestTriangle(const Mesh& mesh);
  bool empty() const { return triangles_.empty(); }
  std::size_t degenerate_triangles() const { return mesh_.triangles.size() - triangles_.size(); }
  /// Distance infinite where no triangle has area.
  MeshPoint at(const glm::dvec3& point) const;

 private:
  struct Node {
    glm::dvec3 lower{0}, upper{0};
    std::uint32_t begin = 0, end = 0;  ///< into triangles_
    std::uint32_t right = 0;           ///< the left child follows its parent; 0: a leaf
  };
  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  void search(std::uint32_t node, const glm::dvec3& point, MeshPoint& best) const;
  void search_leaf(const Node& node, const glm::dvec3& point, MeshPoint& best) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace cuticle::strands
