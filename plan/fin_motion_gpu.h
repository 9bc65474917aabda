#pragma once
// Where a scene's fins are in each frame: simulated on the CPU, or carried rigidly by the head; on the device to draw.
#include <memory>

#include "gpu/device.h"
#include "plan/plan.h"
#include "plan/strand_set.h"
#include "sim/solver.h"

namespace cuticle::plan {

class FinMotion {
 public:
  /// `set` has fins. `effects`: those of the plan that act on hair. Error: that of sim::make_cloth; out_of_memory.
  static Result<std::unique_ptr<FinMotion>> create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                   const StrandSet& set, const Plan& plan);
  /// Back to rest.
  Result<void> restart(const sim::EffectBlocks& effects);
  /// One frame: simulated where the plan holds 'cloth', else carried to head_end.
  Result<void> advance(const sim::FrameInput& input);
  Result<void> carry(const glm::dmat4& head);

  const gpu::Buffer& positions() const { return positions_; }  ///< vec4 per vertex: world place, painted weight
  const gpu::Buffer& normals() const { return normals_; }      ///< vec4 per vertex: unit, 0
  const strands::Mesh& mesh() const { return moved_; }         ///< where they are, world

 private:
  FinMotion(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, const StrandSet& set, const Plan& plan)
      : device_(std::move(device)), scene_(scene), set_(set), plan_(plan), moved_(set.fins) {}
  Result<void> upload();

  std::shared_ptr<gpu::Device> device_;
  const scene::Scene& scene_;
  const StrandSet& set_;
  const Plan& plan_;
  std::unique_ptr<sim::Solver> cloth_;  ///< null: carried
  strands::Mesh moved_;
  gpu::Buffer positions_, normals_;
};

}  // namespace cuticle::plan
