#include "gpu/detail/device_impl.h"

namespace cuticle::gpu {
namespace {

VkPhysicalDeviceFeatures wanted_features(const VkPhysicalDeviceFeatures& offered) {
  VkPhysicalDeviceFeatures wanted{};
  wanted.wideLines = offered.wideLines;
  wanted.vertexPipelineStoresAndAtomics = offered.vertexPipelineStoresAndAtomics;
  wanted.fragmentStoresAndAtomics = offered.fragmentStoresAndAtomics;
  wanted.pipelineStatisticsQuery = offered.pipelineStatisticsQuery;
  wanted.independentBlend = offered.independentBlend;
  return wanted;
}

VkPhysicalDeviceVulkan13Features core13_features() {
  VkPhysicalDeviceVulkan13Features features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  features.dynamicRendering = features.synchronization2 = features.maintenance4 = VK_TRUE;
  return features;
}

/// Buffers whose structs lie as in C++.
VkPhysicalDeviceVulkan12Features core12_features() {
  VkPhysicalDeviceVulkan12Features features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features.scalarBlockLayout = VK_TRUE;
  return features;
}

}  // namespace

Result<void> create_logical_device(Device::Impl& device) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = device.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceVulkan12Features core12 = core12_features();
  VkPhysicalDeviceVulkan13Features core13 = core13_features();
  core13.pNext = &core12;
  vkGetPhysicalDeviceFeatures(device.physical, &device.features);
  device.features = wanted_features(device.features);
  VkDeviceCreateInfo create{};
  create.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  create.pNext = &core13;
  create.queueCreateInfoCount = 1;
  create.pQueueCreateInfos = &queue;
  create.pEnabledFeatures = &device.features;
  CUTICLE_TRY(checked(vkCreateDevice(device.physical, &create, nullptr, &device.device), "vkCreateDevice"));
  volkLoadDeviceTable(&device.vk, device.device);
  device.vk.vkGetDeviceQueue(device.device, device.queue_family, 0, &device.queue);
  return {};
}

}  // namespace cuticle::gpu
