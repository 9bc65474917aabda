#pragma once
// A triangle mesh that hair grows on or collides with.
#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cuticle::strands {

struct Mesh {
  std::vector<glm::vec3> positions;  ///< metres
  std::vector<glm::vec3> normals;    ///< unit, one per position
  std::vector<glm::vec2> uv;         ///< one per position, or empty
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
/// v scaled to length 1; +y where v has no direction.
glm::vec3 unit_or_up(const glm::dvec3& v);
/// Area-weighted vertex normals; vertices of no or degenerate triangles get +y.
void compute_normals(Mesh& mesh);
/// Positions and normals by a rigid transform.
Mesh transformed(const Mesh& mesh, const glm::dmat4& transform);

}  // namespace cuticle::strands
