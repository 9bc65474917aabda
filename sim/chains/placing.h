#pragma once
// Where the head is at the end of a frame and how it moved: for the vertices that it carries.
#include <span>

#include <glm/gtc/quaternion.hpp>

#include "sim/head_motion.h"

namespace cuticle::sim::chains {

/// From a unit quaternion (xyz, w).
glm::dmat3 matrix_of(const glm::vec4& rotation);

class Placing {
 public:
  Placing() = default;
  /// Of a substep of this duration (s) that ends with the second rotation; the origin stays, moving by `velocity`
  /// (m/s).
  Placing(const glm::dmat3& begin, const glm::dmat3& end, const glm::dvec3& velocity, double duration);
  /// The substeps of a frame, at least one.
  void advance(std::span<const Substep> parts);
  const glm::dmat3& rotation() const { return rotation_; }
  glm::dvec3 turned(const glm::dvec3& rest) const { return rotation_ * rest; }
  glm::dvec3 world(const glm::dvec3& rest) const { return translation_ + rotation_ * rest; }
  /// Of a place that the head carries, over the last substep in which time passed, m/s.
  glm::dvec3 velocity(const glm::dvec3& rest) const { return moving_ + turning_ * rest; }

 private:
  glm::dmat3 rotation_{1}, turning_{0};
  glm::dvec3 translation_{0}, moving_{0};
};

}  // namespace cuticle::sim::chains
