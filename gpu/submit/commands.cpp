#include <fmt/format.h>

#include "gpu/detail/commands_impl.h"
#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

constexpr std::size_t k_max_inline_bytes = 65536;  // of vkCmdUpdateBuffer

// May an operation be recorded now? Keeps an error for submit if not.
bool open_for_work(Commands::Impl& commands, std::string_view what) {
  if (commands.in_rendering)
    fail(commands, internal_error(fmt::format("gpu: {} between begin_rendering and end_rendering", what)));
  return !commands.error;
}

bool groups_fit(Commands::Impl& commands, const std::array<std::uint32_t, 3>& groups) {
  const auto& limit = commands.device->impl()->limits.maxComputeWorkGroupCount;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (groups[axis] > limit[axis]) {
      fail(commands, bad_input(fmt::format("gpu: {} workgroups on axis {}: the device allows 0..{}", groups[axis], axis,
                                           limit[axis])));
      return false;
    }
  return true;
}

bool copy_fits(Commands::Impl& commands, std::size_t size, std::size_t offset, std::size_t bytes) {
  if (offset <= size && bytes <= size - offset) return true;
  fail(commands,
       internal_error(fmt::format("gpu: copy of bytes {}..{} of a buffer of {}", offset, offset + bytes, size)));
  return false;
}

VkResult create_command_buffer(Commands::Impl& commands) {
  Device::Impl& device = *commands.device->impl();
  VkCommandPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool.queueFamilyIndex = device.queue_family;
  if (const VkResult result = device.vk.vkCreateCommandPool(device.device, &pool, nullptr, &commands.pool);
      result != VK_SUCCESS)
    return result;
  VkCommandBufferAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocation.commandPool = commands.pool;
  allocation.commandBufferCount = 1;
  return device.vk.vkAllocateCommandBuffers(device.device, &allocation, &commands.buffer);
}

}  // namespace

Commands::Commands(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Commands::Commands(Commands&&) noexcept = default;
Commands::~Commands() = default;

Commands::Impl::~Impl() {
  Device::Impl& owner = *device->impl();
  for (VkDescriptorPool each : descriptor_pools) owner.vk.vkDestroyDescriptorPool(owner.device, each, nullptr);
  for (VkBufferView each : buffer_views) owner.vk.vkDestroyBufferView(owner.device, each, nullptr);
  for (VkQueryPool each : count_pools) owner.vk.vkDestroyQueryPool(owner.device, each, nullptr);
  for (VkQueryPool each : query_pools) owner.vk.vkDestroyQueryPool(owner.device, each, nullptr);
  owner.vk.vkDestroyCommandPool(owner.device, pool, nullptr);
}

void fail(Commands::Impl& commands, Error error) {
  if (!commands.error) commands.error = std::move(error);
}

void begin(Commands::Impl& commands) {
  Device::Impl& device = *commands.device->impl();
  VkResult result = create_command_buffer(commands);
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (result == VK_SUCCESS) result = device.vk.vkBeginCommandBuffer(commands.buffer, &info);
  if (result != VK_SUCCESS) fail(commands, vulkan_error(result, "recording"));
}

std::shared_ptr<BufferObject> object_of(Commands::Impl& commands, const Buffer* buffer) {
  if (!buffer || !*buffer) return fail(commands, internal_error("gpu: an empty buffer was recorded")), nullptr;
  std::shared_ptr<BufferObject> object = buffer->impl()->object;
  if (object->device != commands.device)
    return fail(commands, internal_error("gpu: a buffer of another device")), nullptr;
  commands.used.push_back(object);
  return object;
}

std::shared_ptr<TextureObject> object_of(Commands::Impl& commands, const Texture* texture) {
  if (!texture || !*texture) return fail(commands, internal_error("gpu: an empty texture was recorded")), nullptr;
  std::shared_ptr<TextureObject> object = texture->impl()->object;
  if (object->device != commands.device)
    return fail(commands, internal_error("gpu: a texture of another device")), nullptr;
  commands.used.push_back(object);
  return object;
}

void Commands::begin_pass(std::string_view name) {
  if (!open_for_work(*impl_, "begin_pass")) return;
  if (impl_->open_passes++ > 0) return;
  impl_->passes.push_back({std::string(name)});
  write_timestamp(*impl_, impl_->passes.size() - 1, false);
}

void Commands::end_pass() {
  if (!open_for_work(*impl_, "end_pass")) return;
  if (impl_->open_passes == 0) return fail(*impl_, internal_error("gpu: end_pass without begin_pass"));
  if (--impl_->open_passes > 0) return;
  write_timestamp(*impl_, impl_->passes.size() - 1, true);
}

void Commands::dispatch(const Kernel& kernel, std::initializer_list<const Buffer*> buffers,
                        std::initializer_list<const Texture*> textures, std::span<const std::byte> push_constants,
                        std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) {
  dispatch(kernel, std::span(buffers.begin(), buffers.size()), std::span(textures.begin(), textures.size()),
           push_constants, groups_x, groups_y, groups_z);
}

void Commands::dispatch(const Kernel& kernel, std::span<const Buffer* const> buffers,
                        std::span<const Texture* const> textures, std::span<const std::byte> push_constants,
                        std::uint32_t groups_x, std::uint32_t groups_y, std::uint32_t groups_z) {
  if (!open_for_work(*impl_, "dispatch") || !groups_fit(*impl_, {groups_x, groups_y, groups_z})) return;
  if (!kernel) return fail(*impl_, internal_error("gpu: an empty kernel was dispatched"));
  Device::Impl& device = *impl_->device->impl();
  full_barrier(device, impl_->buffer);
  if (!bind(*impl_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.impl()->object, {buffers, textures, push_constants})) return;
  device.vk.vkCmdDispatch(impl_->buffer, groups_x, groups_y, groups_z);
  if (impl_->open_passes > 0) ++impl_->passes.back().dispatches;
}

void Commands::dispatch_counted(const Kernel& kernel, std::span<const Buffer* const> buffers,
                                std::span<const Texture* const> textures, std::span<const std::byte> push_constants,
                                const Buffer& numbers, std::size_t offset) {
  if (!open_for_work(*impl_, "dispatch_counted")) return;
  if (!kernel) return fail(*impl_, internal_error("gpu: an empty kernel was dispatched"));
  const auto object = object_of(*impl_, &numbers);
  if (!object) return;
  if (offset % 4 != 0 || offset + sizeof(VkDispatchIndirectCommand) > numbers.size())
    return fail(*impl_, internal_error(fmt::format("gpu: numbers of workgroups at {} in a buffer of {} bytes", offset,
                                                   numbers.size())));
  Device::Impl& device = *impl_->device->impl();
  full_barrier(device, impl_->buffer);
  if (!bind(*impl_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.impl()->object, {buffers, textures, push_constants})) return;
  device.vk.vkCmdDispatchIndirect(impl_->buffer, object->handle, numbers.impl()->offset + offset);
  if (impl_->open_passes > 0) ++impl_->passes.back().dispatches;
}

void Commands::fill(const Buffer& buffer, std::uint32_t value) {
  if (!open_for_work(*impl_, "fill")) return;
  const auto object = object_of(*impl_, &buffer);
  if (!object) return;
  Device::Impl& device = *impl_->device->impl();
  full_barrier(device, impl_->buffer);
  const Buffer::Impl& part = *buffer.impl();
  const VkDeviceSize bytes = part.offset + part.bytes == object->size ? VK_WHOLE_SIZE : part.bytes;
  device.vk.vkCmdFillBuffer(impl_->buffer, object->handle, part.offset, bytes, value);
}

void Commands::copy(const Buffer& from, const Buffer& to, std::size_t bytes, std::size_t from_offset,
                    std::size_t to_offset) {
  if (!open_for_work(*impl_, "copy") || bytes == 0) return;
  const auto source = object_of(*impl_, &from), target = object_of(*impl_, &to);
  if (!source || !target) return;
  if (!copy_fits(*impl_, from.size(), from_offset, bytes) || !copy_fits(*impl_, to.size(), to_offset, bytes)) return;
  Device::Impl& device = *impl_->device->impl();
  full_barrier(device, impl_->buffer);
  const VkBufferCopy region{from.impl()->offset + from_offset, to.impl()->offset + to_offset, bytes};
  device.vk.vkCmdCopyBuffer(impl_->buffer, source->handle, target->handle, 1, &region);
}

void Commands::copy(const Buffer& from, const Texture& to, std::size_t from_offset) {
  if (!open_for_work(*impl_, "copy")) return;
  const auto source = object_of(*impl_, &from);
  const auto target = object_of(*impl_, &to);
  if (!source || !target) return;
  const TextureDescription& description = target->description;
  const glm::ivec2 size = description.size;
  const std::size_t texel = bytes_per_texel(description.format);
  if (!copy_fits(*impl_, from.size(), from_offset, texel * std::size_t(size.x) * std::size_t(size.y))) return;
  if (from_offset % texel != 0 || description.samples > 1)
    return fail(*impl_, internal_error("gpu: texels copied from between two texels, or to a multisampled texture"));
  VkBufferImageCopy region{};
  region.bufferOffset = from.impl()->offset + from_offset;
  region.imageSubresource = {aspect_of(description.format), 0, 0, 1};
  region.imageExtent = {std::uint32_t(size.x), std::uint32_t(size.y), 1};
  Device::Impl& device = *impl_->device->impl();
  full_barrier(device, impl_->buffer);
  device.vk.vkCmdCopyBufferToImage(impl_->buffer, source->handle, target->image, VK_IMAGE_LAYOUT_GENERAL, 1, &region);
  record_levels(device, impl_->buffer, *target);
}

void Commands::write(const Buffer& to, std::span<const std::byte> data, std::size_t offset) {
  if (!open_for_work(*impl_, "write") || data.empty()) return;
  const auto target = object_of(*impl_, &to);
  if (!target || !copy_fits(*impl_, target->size, offset, data.size())) return;
  if (data.size() > k_max_inline_bytes || data.size() % 4 != 0 || offset % 4 != 0)
    return fail(*impl_, internal_error(fmt::format("gpu: {} bytes written at {}: at most {}, in multiples of 4",
                                                   data.size(), offset, k_max_inline_bytes)));
  Device::Impl& device = *impl_->device->impl();
  full_barrier(device, impl_->buffer);
  device.vk.vkCmdUpdateBuffer(impl_->buffer, target->handle, offset, data.size(), data.data());
}

}  // namespace cuticle::gpu
