#include "gpu/detail/commands_impl.h"

namespace cuticle::gpu {

void Commands::begin_count(std::string_view name) {
  if (impl_->error || !impl_->device->impl()->info.fragment_counts) return;
  if (impl_->in_rendering || impl_->in_count)
    return fail(*impl_, internal_error("gpu: begin_count within a rendering or another count"));
  Device::Impl& device = *impl_->device->impl();
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS;
  info.queryCount = 1;
  info.pipelineStatistics = VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT;
  VkQueryPool pool = VK_NULL_HANDLE;
  if (const VkResult result = device.vk.vkCreateQueryPool(device.device, &info, nullptr, &pool); result != VK_SUCCESS)
    return fail(*impl_, vulkan_error(result, "vkCreateQueryPool"));
  impl_->count_pools.push_back(pool);
  impl_->counts.push_back({std::string(name)});
  impl_->in_count = true;
  device.vk.vkCmdResetQueryPool(impl_->buffer, pool, 0, 1);
  device.vk.vkCmdBeginQuery(impl_->buffer, pool, 0, 0);
}

void Commands::end_count() {
  if (impl_->error || !impl_->device->impl()->info.fragment_counts) return;
  if (impl_->in_rendering || !impl_->in_count)
    return fail(*impl_, internal_error("gpu: end_count within a rendering or without begin_count"));
  impl_->in_count = false;
  impl_->device->impl()->vk.vkCmdEndQuery(impl_->buffer, impl_->count_pools.back(), 0);
}

void read_counts(Commands::Impl& commands) {
  Device::Impl& device = *commands.device->impl();
  for (std::size_t k = 0; k < commands.counts.size(); ++k)
    device.vk.vkGetQueryPoolResults(device.device, commands.count_pools[k], 0, 1, sizeof(std::uint64_t),
                                    &commands.counts[k].invocations, sizeof(std::uint64_t),
                                    VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
}

}  // namespace cuticle::gpu
