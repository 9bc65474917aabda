#include <fmt/format.h>

#include "gpu/detail/commands_impl.h"

namespace cuticle::gpu {
namespace {

Result<void> check_closed(const Device* device, const Commands::Impl& commands) {
  if (commands.device.get() != device) return internal_error("gpu: commands recorded by another device");
  if (commands.error) return *commands.error;
  if (commands.in_rendering) return internal_error("gpu: submitted without end_rendering");
  if (commands.in_count) return internal_error("gpu: submitted without end_count");
  if (commands.open_passes > 0)
    return internal_error(fmt::format("gpu: pass {} was not ended", commands.passes.back().name));
  return {};
}

Result<void> check_validation(Device::Impl& device) {
  const std::vector<std::string> messages = device.instance->log.take();
  if (messages.empty()) return {};
  return internal_error(
      fmt::format("Vulkan validation, {} messages, the first: {}", messages.size(), messages.front()));
}

Result<void> close(Device::Impl& device, Commands::Impl& commands) {
  full_barrier(device, commands.buffer);
  return checked(device.vk.vkEndCommandBuffer(commands.buffer), "vkEndCommandBuffer");
}

// The device's clock has its own origin: its first pass is laid at the moment of the submission.
void trace_passes(Trace& trace, const Commands::Impl& commands, const std::vector<std::pair<double, double>>& times,
                  double submitted_us) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto [begin_ms, end_ms] = times[i];
    trace.add({commands.passes[i].name, "gpu", submitted_us + begin_ms * 1e3, (end_ms - begin_ms) * 1e3});
  }
}

}  // namespace

Commands Device::record() {
  auto impl = std::make_unique<Commands::Impl>();
  impl->device = shared_from_this();
  begin(*impl);
  return Commands(std::move(impl));
}

Result<Running> Device::start(Commands commands) {
  CUTICLE_TRY(check_closed(this, *commands.impl()));
  CUTICLE_TRY(close(*impl_, *commands.impl()));
  auto running = std::make_unique<Running::Impl>(std::move(commands));
  CUTICLE_ASSIGN(running->fence, submit_work(*impl_, running->commands.impl()->buffer));
  return Running(std::move(running));
}

Result<SubmitCost> Device::submit(Commands commands, Trace* trace) {
  const ScopedSpan span(trace, "submit");
  const double submitted_us = trace ? trace->now_us() : 0;
  CUTICLE_ASSIGN(Running running, start(std::move(commands)));
  CUTICLE_ASSIGN(SubmitCost cost, running.finish());
  if (trace) trace_passes(*trace, *running.impl_->commands.impl(), running.impl_->times, submitted_us);
  return cost;
}

Running::Impl::~Impl() {
  if (fence == VK_NULL_HANDLE) return;
  Device::Impl& device = *commands.impl()->device->impl();
  device.vk.vkWaitForFences(device.device, 1, &fence, VK_TRUE, UINT64_MAX);
  device.vk.vkDestroyFence(device.device, fence, nullptr);
}

Running::Running(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Running::Running(Running&&) noexcept = default;
Running& Running::operator=(Running&&) noexcept = default;
Running::~Running() = default;

bool Running::is_done() const {
  Device::Impl& device = *impl_->commands.impl()->device->impl();
  return device.vk.vkGetFenceStatus(device.device, impl_->fence) != VK_NOT_READY;
}

Result<SubmitCost> Running::finish() {
  Commands::Impl& work = *impl_->commands.impl();
  Device::Impl& device = *work.device->impl();
  CUTICLE_TRY(
      checked(device.vk.vkWaitForFences(device.device, 1, &impl_->fence, VK_TRUE, UINT64_MAX), "vkWaitForFences"));
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - impl_->begin;
  CUTICLE_TRY(check_validation(device));
  impl_->times = read_timestamps(work);
  read_counts(work);
  return SubmitCost{wall.count(), work.passes, work.counts};
}

}  // namespace cuticle::gpu
