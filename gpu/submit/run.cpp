#include "gpu/detail/device_impl.h"

namespace cuticle::gpu {
namespace {

Result<void> submit_with_fence(Device::Impl& device, VkCommandBuffer commands, VkFence fence) {
  VkCommandBufferSubmitInfo buffer{};
  buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  buffer.commandBuffer = commands;
  VkSubmitInfo2 submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer;
  return checked(device.vk.vkQueueSubmit2(device.queue, 1, &submit, fence), "vkQueueSubmit2");
}

Result<void> record_and_run(Device::Impl& device, VkCommandPool pool, const Recording& work) {
  VkCommandBufferAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocation.commandPool = pool;
  allocation.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  CUTICLE_TRY(
      checked(device.vk.vkAllocateCommandBuffers(device.device, &allocation, &commands), "vkAllocateCommandBuffers"));
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  CUTICLE_TRY(checked(device.vk.vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer"));
  full_barrier(device, commands);
  work(commands);
  full_barrier(device, commands);
  CUTICLE_TRY(checked(device.vk.vkEndCommandBuffer(commands), "vkEndCommandBuffer"));
  return submit_and_wait(device, commands);
}

}  // namespace

Result<VkFence> submit_work(Device::Impl& device, VkCommandBuffer commands) {
  VkFenceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  CUTICLE_TRY(checked(device.vk.vkCreateFence(device.device, &info, nullptr, &fence), "vkCreateFence"));
  const Result<void> submitted = submit_with_fence(device, commands, fence);
  if (submitted) return fence;
  device.vk.vkDestroyFence(device.device, fence, nullptr);
  return submitted.error();
}

Result<void> submit_and_wait(Device::Impl& device, VkCommandBuffer commands) {
  CUTICLE_ASSIGN(const VkFence fence, submit_work(device, commands));
  Result<void> done =
      checked(device.vk.vkWaitForFences(device.device, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  device.vk.vkDestroyFence(device.device, fence, nullptr);
  return done;
}

Result<void> run_now(Device::Impl& device, const Recording& work) {
  VkCommandPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  info.queueFamilyIndex = device.queue_family;
  VkCommandPool pool = VK_NULL_HANDLE;
  CUTICLE_TRY(checked(device.vk.vkCreateCommandPool(device.device, &info, nullptr, &pool), "vkCreateCommandPool"));
  Result<void> done = record_and_run(device, pool, work);
  device.vk.vkDestroyCommandPool(device.device, pool, nullptr);
  return done;
}

void full_barrier(Device::Impl& device, VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
  barrier.dstStageMask = barrier.srcStageMask;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  device.vk.vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace cuticle::gpu
