#include "plan/host_solver_gpu.h"

#include <chrono>

#include <glm/vec4.hpp>

namespace cuticle::plan {

Result<std::unique_ptr<HostSolver>> HostSolver::create(std::shared_ptr<gpu::Device> device,
                                                       std::unique_ptr<sim::Solver> solver, std::string name,
                                                       std::size_t vertices) {
  std::unique_ptr<HostSolver> made(new HostSolver(std::move(device), std::move(solver), std::move(name)));
  for (gpu::Buffer* buffer : {&made->positions_, &made->velocities_}) {
    CUTICLE_ASSIGN(*buffer, made->device_->make_texel_buffer(vertices * sizeof(glm::vec4)));
  }
  return made;
}

Result<gpu::SubmitCost> HostSolver::advance(const sim::FrameInput& input) {
  const auto begin = std::chrono::steady_clock::now();
  CUTICLE_TRY(solver_->advance(input));
  CUTICLE_ASSIGN(state_, solver_->state());
  CUTICLE_TRY(upload(positions_, state_.positions));
  CUTICLE_TRY(upload(velocities_, state_.velocities));
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  return gpu::SubmitCost{spent.count(), {{.name = name_, .gpu_ms = spent.count()}}, {}};
}

Result<void> HostSolver::upload(const gpu::Buffer& buffer, std::span<const glm::vec3> vectors) {
  std::vector<glm::vec4> padded;
  padded.reserve(vectors.size());
  for (const glm::vec3& vector : vectors) padded.emplace_back(vector, 1);
  return device_->upload(buffer, std::as_bytes(std::span<const glm::vec4>(padded)));
}

}  // namespace cuticle::plan
