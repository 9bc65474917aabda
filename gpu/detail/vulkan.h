#pragma once
// Private to gpu/ (not installed): Vulkan, loaded at run time by volk, and its results as our errors.
#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <volk.h>

#include <string>
#include <string_view>

#include "core/result.h"

namespace cuticle::gpu {

Error no_device_error(std::string message, std::string hint);
Error out_of_memory_error(std::string message, std::string hint);
/// The kind follows the result (lost device, memory); `what` names the call that failed.
Error vulkan_error(VkResult result, std::string_view what);
/// Success, or vulkan_error.
Result<void> checked(VkResult result, std::string_view what);

}  // namespace cuticle::gpu
