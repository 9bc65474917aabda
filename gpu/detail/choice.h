#pragma once
// Private to gpu/ (not installed): what devices there are, and which of them a request means.
#include "gpu/detail/instance.h"
#include "gpu/device.h"

namespace cuticle::gpu {

std::vector<VkPhysicalDevice> physical_devices(const Instance& instance);
DeviceInfo describe(VkPhysicalDevice physical, int index);
/// The queue family used for everything (graphics and compute, or compute alone); the family count where there is none.
std::uint32_t queue_family_of(VkPhysicalDevice physical, VkQueueFamilyProperties& properties);

/// The device that `choice` (DeviceRequest::choice, or the environment's) means. Error: no_device, listing what there
/// is.
Result<int> choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice);

}  // namespace cuticle::gpu
