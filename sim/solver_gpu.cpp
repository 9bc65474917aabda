#include "sim/solver_gpu.h"

#include <fmt/core.h>

namespace cuticle::sim {

Result<void> GpuSolver::run(gpu::Device& device, const FrameInput& input) {
  gpu::Commands commands = device.record();
  CUTICLE_TRY(record(commands, input));
  CUTICLE_ASSIGN([[maybe_unused]] const gpu::SubmitCost cost, device.submit(std::move(commands)));
  return {};
}

Result<void> GpuSolver::record_on_skin(gpu::Commands&, const FrameInput&, const gpu::Buffer&) {
  return usage_error("hair on a skin: this solver follows a head only", "leave the effect 'control' out");
}

Result<const GpuEffect*> find_gpu_effect(std::string_view name) {
  for (const GpuEffect* effect : gpu_effects())
    if (effect->name == name && effect->create) return effect;
  return usage_error(fmt::format("'{}' is not a solver with a GPU half", name), "`cuticle effects` lists them");
}

}  // namespace cuticle::sim
