#pragma once
// Frames of a scene without a device: motion by the solvers' CPU twins, pictures by the method 'reference'.
#include <memory>

#include "plan/head_path.h"
#include "plan/plan.h"
#include "plan/strand_set.h"
#include "plan/traced_frame.h"
#include "sim/solver.h"

namespace cuticle::plan {

class TracedSceneRunner {
 public:
  /// Error: usage, where the scene has a character or fins, which are moved on a device; those of build_strand_set.
  static Result<std::unique_ptr<TracedSceneRunner>> create(const scene::Scene& scene, Progress& progress);
  /// Brings the control hairs to a frame, as StrandMotion does: every frame from the last one to this is simulated, an
  /// earlier one starts anew.
  Result<void> advance_to(int frame, Progress& progress);
  /// Paints the frame. Errors: those of advance_to and trace_frame.
  Result<TracedFrame> run(int frame, Progress& progress);
  Result<strands::Groom> drawn_strands();
  const Plan& plan() const { return plan_; }
  const StrandSet& set() const { return set_; }
  const sim::State& state() const { return state_; }

 private:
  explicit TracedSceneRunner(const scene::Scene& scene) : scene_(scene) {}
  Result<void> restart(Progress& progress);
  Result<void> simulate(int frame);
  Camera camera(int frame) const;

  scene::Scene scene_;
  StrandSet set_;
  Plan plan_;
  HeadPath path_;
  std::unique_ptr<sim::Solver> solver_;  ///< null: carried
  sim::State state_;
  int frame_ = -1;
};

}  // namespace cuticle::plan
