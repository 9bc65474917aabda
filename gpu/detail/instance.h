#pragma once
// Private to gpu/ (not installed): the Vulkan instance of one device, and what its validation layer said.
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/detail/vulkan.h"

namespace cuticle::gpu {

/// Messages of the validation layer since the last take(); filled from any thread.
class ValidationLog {
 public:
  void add(std::string message);
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  ValidationLog log;

  Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance();
  /// Error: no_device where the loader, Vulkan 1.3 or (if asked for) the validation layer is missing.
  static Result<std::shared_ptr<Instance>> create(bool validation);
};

/// Sends errors and warnings of the validation layer to the instance's log.
Result<void> listen_to_validation(Instance& instance);
/// Is the validation layer installed?
bool validation_layer_present();
inline constexpr const char* k_validation_layer = "VK_LAYER_KHRONOS_validation";

}  // namespace cuticle::gpu
