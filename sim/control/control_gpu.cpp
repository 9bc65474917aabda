#include "sim/control/control_gpu.h"

#include <control_comp.spv.h>

#include "sim/control/control.h"

namespace cuticle::sim::control {
namespace {

class ControlledGpuSolver final : public GpuSolver {
 public:
  ControlledGpuSolver(std::shared_ptr<gpu::Device> device, std::unique_ptr<GpuSolver> solver, Authored authored)
      : device_(std::move(device)), solver_(std::move(solver)), authored_(std::move(authored)) {}

  Result<void> make() {
    const std::vector<glm::vec4> places(vertices(), glm::vec4(0));
    CUTICLE_ASSIGN(places_, gpu::make_buffer_from(*device_, std::span<const glm::vec4>(places)));
    CUTICLE_ASSIGN(world_, gpu::make_buffer_from(*device_, std::span<const glm::vec4>(places)));
    CUTICLE_ASSIGN(speeds_, gpu::make_buffer_from(*device_, std::span<const glm::vec4>(places)));
    CUTICLE_ASSIGN(velocities_, gpu::make_buffer_from(*device_, std::span<const glm::vec4>(places)));
    CUTICLE_ASSIGN(kernel_, device_->make_kernel(control_comp, {.storage_buffers = 6, .push_constant_bytes = 4}));
    return {};
  }

  Result<void> record(gpu::Commands& commands, const FrameInput& input) override {
    Authored next = authored_;
    CUTICLE_TRY(next.advance(input));
    CUTICLE_TRY(solver_->record(commands, input));
    authored_ = std::move(next);
    CUTICLE_TRY(upload(places_, authored_.places(), authored_.weights()));
    CUTICLE_TRY(upload(speeds_, authored_.velocities(), authored_.weight_rates()));
    commands.begin_pass("control");
    const std::uint32_t count = static_cast<std::uint32_t>(vertices());
    commands.dispatch(kernel_,
                      {&solver_->positions(), &places_, &world_, &solver_->velocities(), &speeds_, &velocities_}, {},
                      gpu::bytes_of(count), (count + 63) / 64);
    commands.end_pass();
    return {};
  }

  Result<void> advance(const FrameInput& input) override { return run(*device_, input); }

  Result<State> state() override {
    CUTICLE_ASSIGN(State state, solver_->state());
    authored_.blend(state);
    return state;
  }

  const gpu::Buffer& positions() const override { return world_; }
  const gpu::Buffer& velocities() const override { return velocities_; }

  std::map<std::string, std::uint32_t> dispatches(const FrameInput& input) const override {
    std::map<std::string, std::uint32_t> result = solver_->dispatches(input);
    result["control"] = 1;
    return result;
  }

 private:
  std::size_t vertices() const { return authored_.places().size(); }

  /// A vector and a number of each vertex.
  Result<void> upload(const gpu::Buffer& buffer, std::span<const glm::vec3> vectors, std::span<const float> numbers) {
    std::vector<glm::vec4> packed(vectors.size());
    for (std::size_t i = 0; i < packed.size(); ++i) packed[i] = glm::vec4(vectors[i], numbers[i]);
    return device_->upload(buffer, std::as_bytes(std::span<const glm::vec4>(packed)));
  }

  std::shared_ptr<gpu::Device> device_;
  std::unique_ptr<GpuSolver> solver_;
  Authored authored_;
  gpu::Buffer places_, speeds_, world_, velocities_;
  gpu::Kernel kernel_;
};

}  // namespace

Result<std::unique_ptr<GpuSolver>> controlled_gpu(std::shared_ptr<gpu::Device> device,
                                                  std::unique_ptr<GpuSolver> solver, const strands::Groom& rest,
                                                  const Control& control) {
  auto made = std::make_unique<ControlledGpuSolver>(std::move(device), std::move(solver), Authored(rest, control));
  CUTICLE_TRY(made->make());
  return std::unique_ptr<GpuSolver>(std::move(made));
}

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"control", nullptr};
  return effect;
}

}  // namespace cuticle::sim::control
