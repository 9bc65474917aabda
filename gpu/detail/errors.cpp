#include <fmt/format.h>

#include "gpu/detail/vulkan.h"

namespace cuticle::gpu {

Error no_device_error(std::string message, std::string hint) {
  return {ErrorKind::no_device, std::move(message), std::move(hint)};
}

Error out_of_memory_error(std::string message, std::string hint) {
  return {ErrorKind::out_of_memory, std::move(message), std::move(hint)};
}

Error vulkan_error(VkResult result, std::string_view what) {
  const std::string message = fmt::format("Vulkan: {} gave {}", what, int(result));
  switch (result) {
    case VK_ERROR_DEVICE_LOST:
      return no_device_error(message + " (the device was lost)", "run again, or choose CUTICLE_DEVICE=cpu");
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return out_of_memory_error(message + " (out of memory)", "use fewer strands or smaller pictures");
    default:
      return internal_error(message);
  }
}

Result<void> checked(VkResult result, std::string_view what) {
  if (result == VK_SUCCESS) return {};
  return vulkan_error(result, what);
}

}  // namespace cuticle::gpu
