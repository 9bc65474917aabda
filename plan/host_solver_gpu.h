#pragma once
// Hair that the CPU's code moves and a device draws.
#include <memory>

#include "gpu/device.h"
#include "sim/solver.h"

namespace cuticle::plan {

class HostSolver {
 public:
  /// `name`: of the pass that its time counts as. Error: out_of_memory.
  static Result<std::unique_ptr<HostSolver>> create(std::shared_ptr<gpu::Device> device,
                                                    std::unique_ptr<sim::Solver> solver, std::string name,
                                                    std::size_t vertices);
  /// One frame, and what it found on the device. The cost is the wall time, as of a pass without dispatches.
  Result<gpu::SubmitCost> advance(const sim::FrameInput& input);

  const gpu::Buffer& positions() const { return positions_; }    ///< as GpuSolver::positions
  const gpu::Buffer& velocities() const { return velocities_; }  ///< as GpuSolver::velocities
  /// After the frame last advanced to.
  const sim::State& state() const { return state_; }

 private:
  HostSolver(std::shared_ptr<gpu::Device> device, std::unique_ptr<sim::Solver> solver, std::string name)
      : device_(std::move(device)), solver_(std::move(solver)), name_(std::move(name)) {}
  Result<void> upload(const gpu::Buffer& buffer, std::span<const glm::vec3> vectors);

  std::shared_ptr<gpu::Device> device_;
  std::unique_ptr<sim::Solver> solver_;
  std::string name_;
  gpu::Buffer positions_, velocities_;
  sim::State state_;
};

}  // namespace cuticle::plan
