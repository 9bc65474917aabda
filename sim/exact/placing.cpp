#include <cuticle/sim/exact/placing.h>

#include <cuticle/core/instruction_set.h>

namespace cuticle::sim::exact {

extern const Kernels kernels_baseline, kernels_avx2, kernels_avx512;

const Kernels& best_kernels() {
#if defined(CUTICLE_HAS_WIDE_SETS)
  if (processor_has(InstructionSet::avx512)) return kernels_avx512;
  if (processor_has(InstructionSet::avx2)) return kernels_avx2;
#endif
  return kernels_baseline;
}

glm::dmat3 matrix_of(const glm::vec4& rotation) {
  const glm::dvec4 q(rotation);
  return glm::dmat3(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)));
}

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

}  // namespace cuticle::sim::exact
