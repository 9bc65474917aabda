#pragma once
// Where the control hairs are in each frame: simulated on the device, carried rigidly by the head, or by a character's
// skin.
#include <cstdint>
#include <memory>

#include "plan/character_motion_gpu.h"
#include "plan/collider_reach.h"
#include "plan/fin_motion_gpu.h"
#include "plan/head_path.h"
#include "plan/host_solver_gpu.h"
#include "plan/plan.h"
#include "plan/strand_set.h"
#include "sim/colliders/placed.h"
#include "sim/solver_gpu.h"
#include "strands/spline/drawn_gpu.h"

namespace cuticle::plan {

class StrandMotion {
 public:
  static Result<std::unique_ptr<StrandMotion>> create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                      const StrandSet& set, const Plan& plan);
  /// Brings the control hairs to a frame: every frame from the last one to this is simulated; an earlier frame starts
  /// anew from rest. Frame 0 is settled at rest, then simulated for one frame with the head still, so that all frames
  /// cost alike. Returns the cost of the last of them. `everything`: as FrameOptions.
  Result<gpu::SubmitCost> advance_to(int frame, Trace* trace, bool everything);

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
  bool records_character() const { return character_ && !scene_.simulation.solver; }
  /// Null where the scene has no fins.
  const FinMotion* fins() const { return fins_.get(); }
  Result<sim::State> state();
  /// Of the frame last advanced to, at its end; none where nothing collides.
  std::vector<sim::PlacedCollider> colliders() const;

  /// Of the frame last advanced to: whether any strand moves, or something acts on hair anew.
  const registry::Fact& hair_awake() const { return awake_; }
  /// Whether any collider comes within reach of any strand (collider_reach.h).
  const registry::Fact& colliders_in_reach() const { return in_reach_; }
  /// Of where the control hairs are, how they move where that is asked for, and what carries them.
  std::uint64_t hair_key() const { return hair_key_; }
  /// Of where head, fins and skin are.
  std::uint64_t surfaces_key() const { return surfaces_key_; }

 private:
  StrandMotion(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, const StrandSet& set, const Plan& plan)
      : device_(std::move(device)), scene_(scene), set_(set), plan_(plan) {}
  Result<void> restart();
  Result<void> settle();
  Result<gpu::SubmitCost> simulate(int frame, Trace* trace);
  Result<gpu::SubmitCost> simulate_on_cpu(sim::FrameInput input, int frame, Trace* trace);
  bool rests(const sim::FrameInput& input) const;
  void leave_out_far_colliders(sim::FrameInput& input);
  Result<void> count_sleepers();
  Result<void> carry_rigidly(int frame);
  Result<void> carry(const gpu::Buffer& places, const glm::dmat4& head);
  Result<void> move_character(int frame);
  Result<void> measure();
  Result<std::vector<glm::vec4>> places();
  void set_keys(std::span<const glm::vec4> places);

  std::shared_ptr<gpu::Device> device_;
  const scene::Scene& scene_;
  const StrandSet& set_;
  const Plan& plan_;
  HeadPath path_;
  std::unique_ptr<sim::GpuSolver> solver_;      ///< null: carried, or solved on the CPU
  std::unique_ptr<HostSolver> host_;            ///< null: not solved on the CPU
  std::unique_ptr<CharacterMotion> character_;  ///< null: carried rigidly
  bool hands_over_motion_ = false;
  std::unique_ptr<FinMotion> fins_;  ///< null: none
  gpu::Buffer carried_, before_;     ///< `before_`: where there is no solver
  strands::Bounds bounds_;
  glm::dmat4 head_{1};
  int frame_ = -1;
  bool everything_ = false;
  std::vector<ReachBall> balls_;       ///< empty where no collider is left out
  std::vector<std::uint8_t> reached_;  ///< hairs that the frame's colliders may touch
  bool near_ = true, was_near_ = true;  ///< whether there are any, in this frame and in the one before
  registry::Fact awake_, in_reach_;
  bool all_sleep_ = false;  ///< after the frame last simulated
  bool overreached_ = false;
  std::uint64_t hair_key_ = 0, surfaces_key_ = 0;
};

}  // namespace cuticle::plan
