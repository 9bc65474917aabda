#pragma once
// GPU half of the manual control: the blended positions stay on the device.
#include "sim/control/control.h"
#include "sim/solver_gpu.h"

namespace cuticle::sim::control {

/// As `controlled`, by one dispatch a frame after those of `solver`. Error: out_of_memory.
Result<std::unique_ptr<GpuSolver>> controlled_gpu(std::shared_ptr<gpu::Device> device,
                                                  std::unique_ptr<GpuSolver> solver, const strands::Groom& rest,
                                                  const Control& control);

}  // namespace cuticle::sim::control
