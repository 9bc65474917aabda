#include "sim/chains/placing.h"

namespace cuticle::sim::chains {

glm::dmat3 matrix_of(const glm::vec4& rotation) {
  const glm::dvec4 q(rotation);
  return glm::dmat3(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)));
}

Placing::Placing(const glm::dmat3& begin, const glm::dmat3& end, const glm::dvec3& velocity, double duration)
    : rotation_(end), turning_(duration > 0 ? (end - begin) / duration : glm::dmat3(0)), moving_(velocity) {}

void Placing::advance(std::span<const Substep> parts) {
  const Substep& last = parts.back();
  const glm::dmat3 carry = matrix_of(parts[0].carry);
  rotation_ = matrix_of(last.rotation_end);
  translation_ = glm::dvec3(last.translation);
  if (last.duration > 0) {
    moving_ = glm::dvec3(last.translation_step) / double(last.duration);
    turning_ = (rotation_ - matrix_of(last.rotation_begin)) / double(last.duration);
  } else {
    moving_ = carry * moving_;
    turning_ = carry * turning_;
  }
}

}  // namespace cuticle::sim::chains
