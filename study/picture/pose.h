#pragma once
// The hair of a ladder's scene where its pictures are drawn: at rest, or as a solver moved it to a frame.
#include <memory>
#include <string>

#include "core/progress.h"
#include "gpu/device.h"
#include "plan/frame_runner_gpu.h"
#include "plan/traced_scene_runner.h"

namespace cuticle::study {

/// Whether the ladder moves this scene's hair: it has a solver, and no character (whose skin moves on a device alone).
inline bool is_simulated(const scene::Scene& scene) { return scene.simulation.solver && !scene.character; }

/// A scene without motion whose hair stands as that of another scene does in a frame.
class Pose {
 public:
  /// Moves the hair by the scene's solver, on the CPU, frame by frame to `frame`. Hair that is not simulated stays at
  /// rest. Errors: the solver's, those of drawing.
  static Result<std::shared_ptr<Pose>> make(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene,
                                            int frame, Progress& progress);
  ~Pose();
  Pose(const Pose&) = delete;
  Pose& operator=(const Pose&) = delete;

  /// `scene` with its hair in this pose, at rest.
  scene::Scene at_rest(const scene::Scene& scene) const;
  /// What a picture draws, and from where.
  const strands::Groom& drawn() const { return drawn_; }
  const Camera& camera() const { return camera_; }
  /// Simulates one frame more; the pose stands. Nothing, where hair is not simulated.
  Result<void> simulate_further();

 private:
  Pose() = default;
  std::unique_ptr<plan::TracedSceneRunner> moving_;  ///< null: not simulated
  int frame_ = 0;
  std::string file_;  ///< of the moved strands, temporary; empty: none
  double opacity_ = 1;
  strands::Groom drawn_;
  Camera camera_;
};

}  // namespace cuticle::study
