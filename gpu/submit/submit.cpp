#include <chrono>

#include <fmt/format.h>

#include <cuticle/gpu/detail/commands_impl.h>

namespace cuticle::gpu {
namespace {

Result<void> check_closed(const Device* device, const Commands::Impl& commands) {
  if (commands.device.get() != device) return internal_error("gpu: commands recorded by another device");
  if (commands.error) return *commands.error;
  if (commands.in_rendering) return internal_error("gpu: submitted without end_rendering");
  if (commands.in_pass) return internal_error(fmt::format("gpu: pass {} was not ended", commands.passes.back().name));
  return {};
}

Result<void> check_validation(Device::Impl& device) {
  const std::vector<std::string> messages = device.instance->log.take();
  if (messages.empty()) return {};
  return internal_error(
      fmt::format("Vulkan validation, {} messages, the first: {}", messages.size(), messages.front()));
}

Result<double> run_timed(Device::Impl& device, Commands::Impl& commands) {
  full_barrier(device, commands.buffer);
  CUTICLE_TRY(checked(device.vk.vkEndCommandBuffer(commands.buffer), "vkEndCommandBuffer"));
  const auto begin = std::chrono::steady_clock::now();
  CUTICLE_TRY(submit_and_wait(device, commands.buffer));
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
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

Result<SubmitCost> Device::submit(Commands commands, Trace* trace) {
  Commands::Impl& work = *commands.impl();
  CUTICLE_TRY(check_closed(this, work));
  const ScopedSpan span(trace, "submit");
  const double submitted_us = trace ? trace->now_us() : 0;
  CUTICLE_ASSIGN(const double wall_ms, run_timed(*impl_, work));
  CUTICLE_TRY(check_validation(*impl_));
  const auto times = read_timestamps(work);
  if (trace) trace_passes(*trace, work, times, submitted_us);
  return SubmitCost{wall_ms, work.passes};
}

}  // namespace cuticle::gpu
