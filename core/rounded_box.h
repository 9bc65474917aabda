#pragma once
// A collider with flat faces, or with a straight axis.
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace cuticle {

/// All places no farther than `radius` from a box: with two half sizes of 0 a capsule, with a radius of 0 a box with
/// sharp edges. Moves as a Sphere does.
struct RoundedBox {
  glm::dvec3 center{0};
  glm::dmat3 axes{1};  ///< columns: unit directions of the box's edges
  glm::dvec3 half_size{0};
  double radius = 0;
};

/// All places no farther than `radius` (metres) from the line between two places; a ball where they are one.
inline RoundedBox make_capsule(const glm::dvec3& from, const glm::dvec3& to, double radius) {
  RoundedBox capsule{.center = (from + to) / 2.0, .half_size = {0, glm::distance(from, to) / 2, 0}, .radius = radius};
  if (!(capsule.half_size.y > 0)) return capsule;
  const glm::dvec3 along = glm::normalize(to - from);
  const glm::dvec3 other = std::abs(along.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 across = glm::normalize(glm::cross(along, other));
  capsule.axes = {across, along, glm::cross(across, along)};
  return capsule;
}

}  // namespace cuticle
