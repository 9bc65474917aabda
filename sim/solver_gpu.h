#pragma once
// GPU half: the same solvers on the device; positions stay there for the passes that follow.
#include <memory>

#include "gpu/device.h"
#include "sim/solver.h"

namespace cuticle::sim {

class GpuSolver : public Solver {
 public:
  /// Records one frame into `commands`, as passes named as the effects ("classic", "colliders"), each opened once per
  /// substep. Submit what was recorded before recording the next frame.
  virtual Result<void> record(gpu::Commands& commands, const FrameInput& input) = 0;
  /// The same for hair on a skin, whose places are on the device: vec4 per vertex, finite, as FrameInput::skinned,
  /// which must be empty. No word of it passes through the CPU. Error: usage where the solver follows a head only.
  virtual Result<void> record_on_skin(gpu::Commands& commands, const FrameInput& input, const gpu::Buffer& skinned);
  /// World positions after the recorded work, vec4 per control vertex.
  virtual const gpu::Buffer& positions() const = 0;
  /// Velocities after the recorded work, as State::velocities has them: vec4 per control vertex, m/s.
  virtual const gpu::Buffer& velocities() const = 0;
  /// Dispatches per effect name that `record` will make for this input: what a plan prints.
  virtual std::map<std::string, std::uint32_t> dispatches(const FrameInput& input) const = 0;

 protected:
  /// Records a frame and waits for it.
  Result<void> run(gpu::Device& device, const FrameInput& input);
};
/// `create` is null for an effect that acts in a solver ("colliders").
struct GpuEffect {
  std::string_view name;
  Result<std::unique_ptr<GpuSolver>> (*create)(std::shared_ptr<gpu::Device>, const strands::Groom& rest,
                                               const registry::ParameterValues& solver, const EffectBlocks& effects);
};
std::span<const GpuEffect* const> gpu_effects();
/// A solver by name. Error: usage.
Result<const GpuEffect*> find_gpu_effect(std::string_view name);

}  // namespace cuticle::sim
