#include <fmt/format.h>

#include "gpu/detail/device_impl.h"

namespace cuticle::gpu {
namespace {

constexpr VkMemoryPropertyFlags k_host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

int find_type(const Device::Impl& device, std::uint32_t allowed, VkMemoryPropertyFlags flags) {
  for (std::uint32_t i = 0; i < device.memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1u) && (device.memory.memoryTypes[i].propertyFlags & flags) == flags) return int(i);
  return -1;
}

// Software Vulkan's memory is the host's own: mapping it spares every copy.
int choose_type(const Device::Impl& device, std::uint32_t allowed, MemoryUse use) {
  const VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  const VkMemoryPropertyFlags first = use == MemoryUse::staging ? k_host | VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                      : device.info.is_software ? local | k_host
                                                                : local;
  const int best = find_type(device, allowed, first);
  if (best >= 0) return best;
  return find_type(device, allowed, use == MemoryUse::staging ? k_host : 0);
}

Error allocation_error(const Device::Impl& device, VkDeviceSize bytes, VkResult result) {
  if (result != VK_ERROR_OUT_OF_DEVICE_MEMORY && result != VK_ERROR_OUT_OF_HOST_MEMORY)
    return vulkan_error(result, "vkAllocateMemory");
  return out_of_memory_error(fmt::format("{} bytes do not fit on {}: {} bytes are in use, its memory has {} bytes",
                                         bytes, device.info.name, device.allocated.load(), device.info.heap_bytes),
                             "use fewer strands, smaller pictures or smaller grids");
}

Result<void> map(Device::Impl& device, Memory& memory) {
  void* mapped = nullptr;
  CUTICLE_TRY(
      checked(device.vk.vkMapMemory(device.device, memory.handle, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory"));
  memory.mapped = static_cast<std::byte*>(mapped);
  return {};
}

}  // namespace

Result<Memory> allocate(Device::Impl& device, const VkMemoryRequirements& needs, MemoryUse use) {
  const int type = choose_type(device, needs.memoryTypeBits, use);
  if (type < 0) return internal_error("Vulkan: no memory type fits");
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = std::uint32_t(type);
  Memory memory;
  memory.bytes = needs.size;
  const VkResult result = device.vk.vkAllocateMemory(device.device, &info, nullptr, &memory.handle);
  if (result != VK_SUCCESS) return allocation_error(device, needs.size, result);
  const VkMemoryPropertyFlags flags = device.memory.memoryTypes[type].propertyFlags;
  const bool map_it = use == MemoryUse::staging || (device.info.is_software && (flags & k_host) == k_host);
  if (auto mapped = map_it ? map(device, memory) : Result<void>(); !mapped) {
    release(device, memory);
    return mapped.error();
  }
  return memory;
}

void release(Device::Impl& device, Memory& memory) {
  device.vk.vkFreeMemory(device.device, memory.handle, nullptr);
  memory = {};
}

void count_allocated(Device::Impl& device, std::size_t bytes) {
  device.allocated += bytes;
  device.peak = std::max(device.peak.load(), device.allocated.load());
}

}  // namespace cuticle::gpu
