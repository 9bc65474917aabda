#include "strands/mesh.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace cuticle::strands {

glm::vec3 unit_or_up(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0, 1, 0);
}

void compute_normals(Mesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (const auto& triangle : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]), c(mesh.positions[triangle[2]]);
    for (std::uint32_t corner : triangle) sums[corner] += glm::cross(b - a, c - a);
  }
  mesh.normals.resize(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) mesh.normals[v] = unit_or_up(sums[v]);
}

Mesh transformed(const Mesh& mesh, const glm::dmat4& transform) {
  Mesh result = mesh;
  const glm::dmat3 rotation(transform);
  for (glm::vec3& position : result.positions) position = glm::vec3(transform * glm::dvec4(position, 1));
  for (glm::vec3& normal : result.normals) normal = glm::vec3(rotation * glm::dvec3(normal));
  return result;
}

}  // namespace cuticle::strands
