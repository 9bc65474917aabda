#include <cuticle/sim/solver_gpu.h>

#include <fmt/core.h>

namespace cuticle::sim {

Result<const GpuEffect*> find_gpu_effect(std::string_view name) {
  for (const GpuEffect* effect : gpu_effects())
    if (effect->name == name && effect->create) return effect;
  return usage_error(fmt::format("'{}' is not a solver with a GPU half", name), "`cuticle effects` lists them");
}

}  // namespace cuticle::sim
