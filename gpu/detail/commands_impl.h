#pragma once
// Private to gpu/ (not installed): a submission being recorded.
#include <chrono>
#include <optional>

#include "gpu/detail/pipeline.h"

namespace cuticle::gpu {

struct Commands::Impl {
  std::shared_ptr<Device> device;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer buffer = VK_NULL_HANDLE;
  std::vector<VkDescriptorPool> descriptor_pools;
  std::vector<VkBufferView> buffer_views;
  std::vector<VkQueryPool> query_pools;           ///< two timestamps a pass, k_passes_per_pool passes a pool
  std::vector<std::shared_ptr<const void>> used;  ///< everything recorded, alive until the work is done
  std::vector<PassCost> passes;
  std::vector<VkQueryPool> count_pools;  ///< one query each, of fragments
  std::vector<FragmentCount> counts;
  int open_passes = 0;
  bool in_rendering = false, in_count = false;
  std::optional<Error> error;  ///< the first misuse; submit returns it

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();
};

struct Running::Impl {
  Commands commands;
  VkFence fence = VK_NULL_HANDLE;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::vector<std::pair<double, double>> times;  ///< of the passes, once finished

  explicit Impl(Commands work) : commands(std::move(work)) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();
};

/// Keeps the first error for submit.
void fail(Commands::Impl& commands, Error error);
/// Starts the command buffer; errors are kept for submit.
void begin(Commands::Impl& commands);
void write_timestamp(Commands::Impl& commands, std::size_t pass, bool at_end);
/// Fills the gpu_ms of every pass, and gives [begin, end] in milliseconds since the first pass began.
std::vector<std::pair<double, double>> read_timestamps(Commands::Impl& commands);

/// Fills in what was counted.
void read_counts(Commands::Impl& commands);

/// What a dispatch or a draw is bound with.
struct Resources {
  std::span<const Buffer* const> buffers;
  std::span<const Texture* const> textures;
  std::span<const std::byte> push_constants;
};
/// Binds a pipeline and its resources; false (and an error kept) where they do not fit its interface.
bool bind(Commands::Impl& commands, VkPipelineBindPoint point, const std::shared_ptr<PipelineObject>& pipeline,
          const Resources& resources);
VkDescriptorSet allocate_set(Commands::Impl& commands, VkDescriptorSetLayout layout);
/// The shared object behind a handle of this device; null (and an error kept) for an empty handle or another device's.
std::shared_ptr<BufferObject> object_of(Commands::Impl& commands, const Buffer* buffer);
std::shared_ptr<TextureObject> object_of(Commands::Impl& commands, const Texture* texture);

}  // namespace cuticle::gpu
