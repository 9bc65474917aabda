#include "gpu/detail/instance.h"

namespace cuticle::gpu {
namespace {

constexpr const char* k_install_hint = "install libvulkan1 and mesa-vulkan-drivers (software Vulkan), or a GPU driver";

// volk keeps its entry points in globals; they are the same for every instance, but are written anew for each.
std::mutex& loader_mutex() {
  static std::mutex mutex;
  return mutex;
}

Result<void> find_loader() {
  if (volkInitialize() != VK_SUCCESS) return no_device_error("no Vulkan loader (libvulkan.so.1)", k_install_hint);
  if (volkGetInstanceVersion() < VK_API_VERSION_1_3)
    return no_device_error("the Vulkan loader is older than 1.3", k_install_hint);
  return {};
}

Result<void> create_handle(Instance& instance, bool validation) {
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pNext = nullptr,
                                      .pApplicationName = "cuticle",
                                      .applicationVersion = 1,
                                      .pEngineName = "cuticle",
                                      .engineVersion = 1,
                                      .apiVersion = VK_API_VERSION_1_3};
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkInstanceCreateInfo create{};
  create.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  create.pApplicationInfo = &application;
  create.enabledLayerCount = create.enabledExtensionCount = validation ? 1 : 0;
  create.ppEnabledLayerNames = &k_validation_layer;
  create.ppEnabledExtensionNames = &extension;
  const VkResult result = vkCreateInstance(&create, nullptr, &instance.handle);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return no_device_error("no Vulkan driver was found", k_install_hint);
  return checked(result, "vkCreateInstance");
}

}  // namespace

Result<std::shared_ptr<Instance>> Instance::create(bool validation) {
  const std::lock_guard lock(loader_mutex());
  CUTICLE_TRY(find_loader());
  if (validation && !validation_layer_present())
    return no_device_error("validation was asked for, but VK_LAYER_KHRONOS_validation is not installed",
                           "install vulkan-validationlayers, or unset CUTICLE_VALIDATION");
  auto instance = std::make_shared<Instance>();
  CUTICLE_TRY(create_handle(*instance, validation));
  volkLoadInstanceOnly(instance->handle);
  if (validation) CUTICLE_TRY(listen_to_validation(*instance));
  return instance;
}

Instance::~Instance() {
  if (handle == VK_NULL_HANDLE) return;
  const auto destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(handle, "vkDestroyDebugUtilsMessengerEXT"));
  if (messenger != VK_NULL_HANDLE && destroy_messenger) destroy_messenger(handle, messenger, nullptr);
  vkDestroyInstance(handle, nullptr);
}

}  // namespace cuticle::gpu
