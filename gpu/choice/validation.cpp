#include <algorithm>
#include <cstring>
#include <utility>

#include "gpu/detail/instance.h"

namespace cuticle::gpu {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL take_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  static_cast<ValidationLog*>(log)->add(data->pMessage);
  return VK_FALSE;
}

}  // namespace

void ValidationLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

bool validation_layer_present() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(),
                     [](const VkLayerProperties& layer) { return !std::strcmp(layer.layerName, k_validation_layer); });
}

Result<void> listen_to_validation(Instance& instance) {
  VkDebugUtilsMessengerCreateInfoEXT create{};
  create.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  create.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  create.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  create.pfnUserCallback = take_message;
  create.pUserData = &instance.log;
  const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance.handle, "vkCreateDebugUtilsMessengerEXT"));
  return checked(create_messenger(instance.handle, &create, nullptr, &instance.messenger),
                 "vkCreateDebugUtilsMessengerEXT");
}

}  // namespace cuticle::gpu
