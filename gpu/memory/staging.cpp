#include <algorithm>

#include "gpu/detail/device_impl.h"

namespace cuticle::gpu {

Result<Staging*> staging_of(Device::Impl& device, std::size_t bytes) {
  const std::size_t wanted = std::min(std::max(bytes, std::size_t(1) << 16), k_staging_limit);
  if (device.staging.memory.bytes >= wanted) return &device.staging;
  release_staging(device);
  const VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  CUTICLE_ASSIGN(device.staging.buffer, create_buffer_handle(device, wanted, usage));
  VkMemoryRequirements needs{};
  device.vk.vkGetBufferMemoryRequirements(device.device, device.staging.buffer, &needs);
  CUTICLE_ASSIGN(device.staging.memory, allocate(device, needs, MemoryUse::staging));
  CUTICLE_TRY(
      checked(device.vk.vkBindBufferMemory(device.device, device.staging.buffer, device.staging.memory.handle, 0),
              "vkBindBufferMemory"));
  return &device.staging;
}

void release_staging(Device::Impl& device) {
  device.vk.vkDestroyBuffer(device.device, device.staging.buffer, nullptr);
  device.staging.buffer = VK_NULL_HANDLE;
  release(device, device.staging.memory);
}

}  // namespace cuticle::gpu
