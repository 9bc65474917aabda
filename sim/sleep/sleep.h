#pragma once
// When strands sleep, and what wakes them.
#include <vector>

#include "sim/solver.h"

namespace cuticle::sim::sleep {

struct Settings {
  static constexpr std::string_view name = "sleep";
  float speed = 0.002f, time = 0.5f;
};
void describe(registry::Members& members, Settings& sleep);

/// Follows from frame to frame what acts on strands.
class Watch {
 public:
  /// `pushes`: what acts on all strands alike, of each substep. Whether nothing in this frame differs from the frame before: the head stands where it stood, colliders and pushes
  /// are bit for bit what they were, and those that move by themselves rest, time passes, and it is no teleport. False
  /// for the first frame.
  bool is_still(const FrameInput& input, const std::vector<Push>& pushes);

 private:
  bool started_ = false;
  glm::dmat4 head_{1};
  std::vector<Sphere> colliders_;
  std::vector<RoundedBox> boxes_;
  std::vector<FieldPointer> fields_;
  std::vector<Placement> moving_;
  Push push_;
};

}  // namespace cuticle::sim::sleep
