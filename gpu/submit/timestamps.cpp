#include "gpu/detail/commands_impl.h"

namespace cuticle::gpu {
namespace {

constexpr std::size_t k_passes_per_pool = 64;
constexpr std::uint32_t k_queries = 2 * k_passes_per_pool;

bool add_query_pool(Commands::Impl& commands) {
  Device::Impl& device = *commands.device->impl();
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = k_queries;
  VkQueryPool pool = VK_NULL_HANDLE;
  if (const VkResult result = device.vk.vkCreateQueryPool(device.device, &info, nullptr, &pool); result != VK_SUCCESS)
    return fail(commands, vulkan_error(result, "vkCreateQueryPool")), false;
  commands.query_pools.push_back(pool);
  device.vk.vkCmdResetQueryPool(commands.buffer, pool, 0, k_queries);
  return true;
}

std::uint64_t read_query(Commands::Impl& commands, std::size_t pass, bool at_end) {
  Device::Impl& device = *commands.device->impl();
  std::uint64_t ticks = 0;
  device.vk.vkGetQueryPoolResults(device.device, commands.query_pools[pass / k_passes_per_pool],
                                  std::uint32_t(2 * (pass % k_passes_per_pool) + at_end), 1, sizeof ticks, &ticks,
                                  sizeof ticks, VK_QUERY_RESULT_64_BIT);
  return ticks;
}

// Ticks wrap at the number of valid bits.
std::uint64_t ticks_between(std::uint64_t from, std::uint64_t to, std::uint32_t bits) {
  return bits >= 64 ? to - from : (to - from) & ((std::uint64_t(1) << bits) - 1);
}

}  // namespace

void write_timestamp(Commands::Impl& commands, std::size_t pass, bool at_end) {
  Device::Impl& device = *commands.device->impl();
  if (!device.info.timestamps) return;
  if (pass / k_passes_per_pool >= commands.query_pools.size() && !add_query_pool(commands)) return;
  device.vk.vkCmdWriteTimestamp2(commands.buffer, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                 commands.query_pools[pass / k_passes_per_pool],
                                 std::uint32_t(2 * (pass % k_passes_per_pool) + at_end));
}

std::vector<std::pair<double, double>> read_timestamps(Commands::Impl& commands) {
  Device::Impl& device = *commands.device->impl();
  if (!device.info.timestamps || commands.passes.empty()) return {};
  const std::uint64_t origin = read_query(commands, 0, false);
  const double ms_per_tick = double(device.limits.timestampPeriod) * 1e-6;
  std::vector<std::pair<double, double>> times;
  for (std::size_t pass = 0; pass < commands.passes.size(); ++pass) {
    const std::uint64_t begin = read_query(commands, pass, false), end = read_query(commands, pass, true);
    times.emplace_back(double(ticks_between(origin, begin, device.timestamp_bits)) * ms_per_tick,
                       double(ticks_between(origin, end, device.timestamp_bits)) * ms_per_tick);
    commands.passes[pass].gpu_ms = times.back().second - times.back().first;
  }
  return times;
}

}  // namespace cuticle::gpu
