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
  /// Takes in a frame. `pushes`: what acts on all strands alike, of each substep. `on_skin`: a skin carries the hair,
  /// and whether it moves a strand is not told here.
  void follow(const FrameInput& input, const std::vector<Push>& pushes, bool on_skin);
  /// Whether something in the frame last followed differs, for this strand, from the frame before: the head does not
  /// stand where it stood, pushes are not bit for bit what they were, no time passes, it is a teleport, or the first
  /// frame; or colliders are others or move by themselves, and one may touch the strand in either frame
  /// (FrameInput::reached; any may, where that is not told).
  bool wakes(std::size_t strand) const;

 private:
  bool keeps_colliders(const FrameInput& input);

  enum class Change { nothing, colliders, all } change_ = Change::all;
  std::vector<std::uint8_t> reached_, reached_before_;
  bool started_ = false;
  glm::dmat4 head_{1};
  std::vector<Sphere> colliders_;
  std::vector<RoundedBox> boxes_;
  std::vector<FieldPointer> fields_;
  std::vector<Placement> moving_;
  Push push_;
};

}  // namespace cuticle::sim::sleep
