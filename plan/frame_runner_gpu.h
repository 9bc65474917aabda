#pragma once
// Runs the frames of a scene by its plan on one device.
#include <map>
#include <memory>
#include <string>

#include "core/image/deep.h"
#include "core/progress.h"
#include "core/trace.h"
#include "gpu/device.h"
#include "lut/table_set.h"
#include "plan/frame_plan.h"
#include "plan/plan.h"
#include "sim/colliders/placed.h"
#include "sim/solver.h"

namespace cuticle::plan {

struct FrameOptions {
  bool render = true;       ///< false: simulate only
  bool read_state = false;  ///< control hairs' state in the result
  /// Every pass of the plan runs, also where this frame would leave it out (FramePlan). A frame that is asked for again
  /// is drawn anew in any case.
  bool everything = false;
  std::string path_state = {};  ///< of the method 'reference': file of a picture's sums, gone on from where it is there
  Progress* progress = nullptr;  ///< of its samples
};
struct FrameResult {
  Image color;       ///< linear RGBA
  Image aovs;        ///< color, then what each pixel sees, when the scene asks for it and its method can tell
  /// What each pixel sees of each strand (objects from 1) and of the rest (0), when the scene asks for it.
  std::vector<SeenShare> shares;
  sim::State state;  ///< when asked for; with it, where colliders and head stand at the frame's end
  std::vector<sim::PlacedCollider> colliders;
  glm::dmat4 head{1};
  /// Passes named as the plan names them; of a solver on the CPU its wall time. wall_ms: of all submissions, those
  /// that a too small buffer made necessary among them, and of the CPU's solver.
  gpu::SubmitCost cost;
  double clock_ms = 0;             ///< from the call to its end
  double read_back_ms = 0;         ///< of it, for bringing the picture from the device
  std::uint32_t repeats = 0;       ///< how often passes ran again because a buffer was too small
  std::vector<std::string> notes;  ///< what was left out of the picture, one sentence each
};

/// Owns everything a scene needs on the device. Frames are run in order; running frame k advances the simulation to k.
class FrameRunner {
 public:
  static Result<std::unique_ptr<FrameRunner>> create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                     Progress& progress, Trace* trace = nullptr);
  ~FrameRunner();
  /// The same hair by a changed scene: material, solver and effects, shadow method and opacity of fibres, passes, way of
  /// drawing and camera may differ, each with its parameters; the rest is not read again. Makes anew only what they touch; frames are as
  /// those of a new runner. Errors: as create, and usage for another resolution; the scene before then stands.
  Result<void> change(const scene::Scene& scene, Progress& progress);
  const Plan& plan() const;
  /// What of it the frame last run did.
  const FramePlan& frame_plan() const;
  /// Device memory by what holds it: passes, the solver (or "control hairs"), "drawn strands", "targets".
  std::map<std::string, std::size_t, std::less<>> memory() const;
  Camera camera(int frame) const;
  /// Where the scene's fins were in the frame last run, world; null: it has none.
  const strands::Mesh* fins() const;
  const strands::Groom& control_groom() const;    ///< simulated hairs at rest
  const std::vector<std::string>& notes() const;  ///< what was guessed or left out when the hair was read
  const lut::TableSet& tables() const;
  Result<FrameResult> run(int frame, const FrameOptions& options = {});
  /// The drawn strands of the frame last run, read back.
  Result<strands::Groom> drawn_strands();

 private:
  struct Impl;
  explicit FrameRunner(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace cuticle::plan
