#include <algorithm>
#include <cstdlib>

#include "gpu/detail/choice.h"
#include "gpu/detail/device_impl.h"

namespace cuticle::gpu {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

void describe_physical(Device::Impl& device, VkPhysicalDevice physical, const DeviceInfo& info) {
  device.physical = physical;
  device.info = info;
  VkQueueFamilyProperties family{};
  device.queue_family = queue_family_of(physical, family);
  device.timestamp_bits = family.timestampValidBits;
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  device.limits = properties.limits;
  vkGetPhysicalDeviceMemoryProperties(physical, &device.memory);
}

Result<void> choose_physical(Device::Impl& device, const std::string& choice) {
  const std::vector<VkPhysicalDevice> physical = physical_devices(*device.instance);
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice each : physical) infos.push_back(describe(each, int(infos.size())));
  CUTICLE_ASSIGN(const int chosen, choose_device(infos, choice));
  describe_physical(device, physical[std::size_t(chosen)], infos[std::size_t(chosen)]);
  return {};
}

void limit_storage(Device::Impl& device, std::uint32_t most_bytes) {
  if (most_bytes == 0) return;
  device.limits.maxStorageBufferRange = std::min(device.limits.maxStorageBufferRange, most_bytes);
  device.info.max_storage_buffer_bytes = std::min<std::uint64_t>(device.info.max_storage_buffer_bytes, most_bytes);
}

}  // namespace

Device::Device() : impl_(std::make_unique<Impl>()) {}
Device::~Device() = default;
const DeviceInfo& Device::info() const { return impl_->info; }
std::size_t Device::allocated_bytes() const { return impl_->allocated; }
std::size_t Device::peak_allocated_bytes() const { return impl_->peak; }

Result<std::shared_ptr<Device>> Device::open(const DeviceRequest& request) {
  std::shared_ptr<Device> device(new Device);
  const bool validation = request.validation || environment("CUTICLE_VALIDATION") == "1";
  CUTICLE_ASSIGN(device->impl_->instance, Instance::create(validation));
  CUTICLE_TRY(choose_physical(*device->impl_, request.choice.empty() ? environment("CUTICLE_DEVICE") : request.choice));
  limit_storage(*device->impl_, request.most_storage_bytes);
  CUTICLE_TRY(create_logical_device(*device->impl_));
  return device;
}

Device::Impl::~Impl() {
  if (device == VK_NULL_HANDLE) return;
  pipelines.clear();
  release_staging(*this);
  vk.vkDestroyDevice(device, nullptr);
}

}  // namespace cuticle::gpu
