#include <algorithm>

#include <fmt/format.h>

#include "gpu/detail/choice.h"

namespace cuticle::gpu {
namespace {

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  return families;
}

std::uint64_t device_heap(VkPhysicalDevice physical) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  std::uint64_t bytes = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      bytes = std::max(bytes, memory.memoryHeaps[i].size);
  return bytes;
}

std::vector<int> sample_counts(const VkPhysicalDeviceLimits& limits) {
  const VkSampleCountFlags both = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
  std::vector<int> counts;
  for (int count = 1; count <= 64; count *= 2)
    if (both & VkSampleCountFlags(count)) counts.push_back(count);
  return counts;
}

std::string version_text(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

std::string why_unusable(VkPhysicalDevice physical, std::uint32_t api_version) {
  if (api_version < VK_API_VERSION_1_3) return "its Vulkan is older than 1.3";
  VkQueueFamilyProperties family{};
  if (queue_family_of(physical, family) >= queue_families(physical).size())
    return "it has no graphics and compute queue";
  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  VkPhysicalDeviceVulkan13Features features13{};
  features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  features13.pNext = &features12;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &features13;
  vkGetPhysicalDeviceFeatures2(physical, &features);
  if (features13.dynamicRendering && features13.synchronization2 && features13.maintenance4 &&
      features12.scalarBlockLayout)
    return {};
  return "it lacks dynamicRendering, synchronization2, maintenance4 or scalarBlockLayout";
}

void describe_limits(DeviceInfo& info, const VkPhysicalDeviceLimits& limits,
                     const VkPhysicalDeviceVulkan13Properties& core13,
                     const VkPhysicalDeviceVulkan11Properties& core11) {
  info.max_storage_buffer_bytes =
      std::min({std::uint64_t(limits.maxStorageBufferRange), core13.maxBufferSize, core11.maxMemoryAllocationSize});
  info.max_texel_buffer_bytes = std::min(
      {16 * std::uint64_t(limits.maxTexelBufferElements), core13.maxBufferSize, core11.maxMemoryAllocationSize});
  info.max_workgroup_invocations = limits.maxComputeWorkGroupInvocations;
  info.max_image_size = limits.maxImageDimension2D;
  info.sample_counts = sample_counts(limits);
  info.subgroup_size = core11.subgroupSize;
  constexpr VkSubgroupFeatureFlags needed = VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT;
  info.subgroup_broadcast = (core11.subgroupSupportedOperations & needed) == needed &&
                            (core11.subgroupSupportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
}

}  // namespace

std::vector<VkPhysicalDevice> physical_devices(const Instance& instance) {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance.handle, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance.handle, &count, devices.data());
  return devices;
}

std::uint32_t queue_family_of(VkPhysicalDevice physical, VkQueueFamilyProperties& properties) {
  const std::vector<VkQueueFamilyProperties> families = queue_families(physical);
  constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  const auto found = std::find_if(families.begin(), families.end(), [](const VkQueueFamilyProperties& family) {
    return (family.queueFlags & needed) == needed;
  });
  if (found != families.end()) properties = *found;
  return std::uint32_t(found - families.begin());
}

DeviceInfo describe(VkPhysicalDevice physical, int index) {
  VkPhysicalDeviceVulkan13Properties core13{};
  core13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
  VkPhysicalDeviceVulkan12Properties core12{};
  core12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
  core12.pNext = &core13;
  VkPhysicalDeviceVulkan11Properties core11{};
  core11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  core11.pNext = &core12;
  VkPhysicalDeviceProperties2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  all.pNext = &core11;
  vkGetPhysicalDeviceProperties2(physical, &all);
  VkPhysicalDeviceFeatures features{};
  vkGetPhysicalDeviceFeatures(physical, &features);
  VkQueueFamilyProperties family{};
  queue_family_of(physical, family);

  DeviceInfo info;
  info.index = index;
  info.name = all.properties.deviceName;
  info.driver = fmt::format("{} {}", core12.driverName, core12.driverInfo);
  info.api_version = version_text(all.properties.apiVersion);
  info.is_software = all.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  describe_limits(info, all.properties.limits, core13, core11);
  info.heap_bytes = device_heap(physical);
  info.timestamps = family.timestampValidBits > 0 && all.properties.limits.timestampPeriod > 0;
  info.wide_lines = features.wideLines;
  info.fragment_counts = features.pipelineStatisticsQuery;
  info.unusable = why_unusable(physical, all.properties.apiVersion);
  return info;
}

std::vector<DeviceInfo> list_devices() {
  const auto instance = Instance::create(false);
  if (!instance) return {};
  std::vector<DeviceInfo> devices;
  for (VkPhysicalDevice physical : physical_devices(**instance))
    devices.push_back(describe(physical, int(devices.size())));
  return devices;
}

}  // namespace cuticle::gpu
