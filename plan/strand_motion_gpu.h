#pragma once
// Where the control hairs are in each frame: simulated on the device, carried rigidly by the head, or by a character's
// skin.
#include <memory>

#include "plan/character_motion_gpu.h"
#include "plan/fin_motion_gpu.h"
#include "plan/head_path.h"
#include "plan/plan.h"
#include "plan/strand_set.h"
#include "sim/solver_gpu.h"
#include "strands/spline/drawn_gpu.h"

namespace cuticle::plan {

class StrandMotion {
 public:
  static Result<std::unique_ptr<StrandMotion>> create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                      const StrandSet& set, const Plan& plan);
  /// Brings the control hairs to a frame: every frame from the last one to this is simulated; an earlier frame starts
  /// anew from rest. Frame 0 is settled at rest, then simulated for one frame with the head still, so that all frames
  /// cost alike. Returns the cost of the last of them.
  Result<gpu::SubmitCost> advance_to(int frame, Trace* trace);

  /// World positions, vec4 per control vertex. Carried by a character: written when its motion is recorded.
  const gpu::Buffer& positions() const;
  const strands::Bounds& bounds() const { return bounds_; }
  const glm::dmat4& head() const { return head_; }
  /// As HeadPath::travel; of any frame.
  glm::dvec3 head_travel(int frame) const { return path_.travel(frame); }
  /// How they move: as the solver says; without one by where they were a frame before, of frame 0 where they are.
  /// Without values unless the plan holds the pass 'velocity'.
  strands::ControlMotion control_motion() const;
  /// Null where the scene has no character.
  CharacterMotion* character() const { return character_.get(); }
  /// Whether the picture has yet to record the character's motion: hair simulated on its skin is moved already.
  bool records_character() const { return character_ && !solver_; }
  /// Null where the scene has no fins.
  const FinMotion* fins() const { return fins_.get(); }
  Result<sim::State> state();

 private:
  StrandMotion(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, const StrandSet& set, const Plan& plan)
      : device_(std::move(device)), scene_(scene), set_(set), plan_(plan) {}
  Result<void> restart();
  Result<void> settle();
  sim::FrameInput input_of(int frame) const;
  Result<gpu::SubmitCost> simulate(int frame, Trace* trace);
  Result<void> carry_rigidly(int frame);
  Result<void> carry(const gpu::Buffer& places, const glm::dmat4& head);
  Result<void> move_character(int frame);
  Result<void> measure();

  std::shared_ptr<gpu::Device> device_;
  const scene::Scene& scene_;
  const StrandSet& set_;
  const Plan& plan_;
  HeadPath path_;
  std::unique_ptr<sim::GpuSolver> solver_;      ///< null: carried
  std::unique_ptr<CharacterMotion> character_;  ///< null: carried rigidly
  bool hands_over_motion_ = false;
  std::unique_ptr<FinMotion> fins_;  ///< null: none
  gpu::Buffer carried_, before_;     ///< `before_`: where there is no solver
  strands::Bounds bounds_;
  glm::dmat4 head_{1};
  int frame_ = -1;
};

}  // namespace cuticle::plan
