#pragma once
// Private to gpu/ (not installed): what a Device and its memory consist of.
#include <atomic>
#include <functional>
#include <map>

#include "gpu/detail/instance.h"
#include "gpu/device.h"

namespace cuticle::gpu {

/// One allocation; `mapped` where the host sees it (always coherent).
struct Memory {
  VkDeviceMemory handle = VK_NULL_HANDLE;
  VkDeviceSize bytes = 0;
  std::byte* mapped = nullptr;
};
enum class MemoryUse { device, staging };

/// A host-visible buffer through which data goes to and from device memory that the host does not see.
struct Staging {
  VkBuffer buffer = VK_NULL_HANDLE;
  Memory memory;
};

struct PipelineObject;

/// Pipelines by a key of all that they are made of (ContentKey), so that none is made twice: on software Vulkan making
/// them is most of what comes before a first picture. Beyond k_most of them those that nothing holds are destroyed, the
/// one asked for longest ago first.
class SharedPipelines {
 public:
  static constexpr std::size_t k_most = 512;
  /// Null where there is none.
  std::shared_ptr<PipelineObject> find(std::uint64_t key);
  void keep(std::uint64_t key, std::shared_ptr<PipelineObject> object);
  /// How many were made since the device was opened.
  std::size_t made() const;
  void clear();

 private:
  struct Entry {
    std::shared_ptr<PipelineObject> object;
    std::uint64_t asked = 0;  ///< by the clock below
  };
  void destroy_unused();

  mutable std::mutex mutex_;
  std::map<std::uint64_t, Entry> entries_;
  std::uint64_t clock_ = 0;
  std::size_t made_ = 0;
};

struct Device::Impl {
  std::shared_ptr<Instance> instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VolkDeviceTable vk{};
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  std::uint32_t timestamp_bits = 0;
  VkPhysicalDeviceMemoryProperties memory{};
  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceFeatures features{};
  DeviceInfo info;
  Staging staging;
  SharedPipelines pipelines;
  std::atomic<std::size_t> allocated{0}, peak{0};

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();
};

/// The logical device and its queue on an already chosen physical device.
Result<void> create_logical_device(Device::Impl& device);

Result<Memory> allocate(Device::Impl& device, const VkMemoryRequirements& needs, MemoryUse use);
void release(Device::Impl& device, Memory& memory);
/// Counts memory of buffers and textures (staging is not counted).
void count_allocated(Device::Impl& device, std::size_t bytes);
Result<VkBuffer> create_buffer_handle(Device::Impl& device, std::size_t bytes, VkBufferUsageFlags usage);

/// The staging buffer, at least `bytes` large (at most k_staging_limit).
inline constexpr std::size_t k_staging_limit = std::size_t(64) << 20;
Result<Staging*> staging_of(Device::Impl& device, std::size_t bytes);
void release_staging(Device::Impl& device);

/// Records with `work`, runs and waits.
using Recording = std::function<void(VkCommandBuffer)>;
Result<void> run_now(Device::Impl& device, const Recording& work);
/// Submits a finished command buffer; the fence, which is the caller's, shows its end.
Result<VkFence> submit_work(Device::Impl& device, VkCommandBuffer commands);
/// Submits a finished command buffer and waits for it.
Result<void> submit_and_wait(Device::Impl& device, VkCommandBuffer commands);
/// Everything before it is done and seen by everything after it, the host included.
void full_barrier(Device::Impl& device, VkCommandBuffer commands);

/// A buffer with its memory; shared so that recorded work outlives the handle it was recorded with.
struct BufferObject {
  std::shared_ptr<Device> device;
  VkBuffer handle = VK_NULL_HANDLE;
  Memory memory;
  std::size_t size = 0;
  ~BufferObject();
};
struct Buffer::Impl {
  std::shared_ptr<BufferObject> object;
  std::size_t offset = 0, bytes = 0;  ///< the part of it
};

struct TextureObject {
  std::shared_ptr<Device> device;
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkSampler sampler = VK_NULL_HANDLE;
  Memory memory;
  TextureDescription description;
  ~TextureObject();
};
struct Texture::Impl {
  std::shared_ptr<TextureObject> object;
};

}  // namespace cuticle::gpu
