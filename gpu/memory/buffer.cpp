#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "core/expect.h"
#include "gpu/detail/device_impl.h"
#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

constexpr std::size_t k_smallest_buffer = 16;
constexpr std::size_t k_part_alignment = 256;  ///< the most that Vulkan lets a device ask for
constexpr VkBufferUsageFlags k_usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                       VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                       VK_BUFFER_USAGE_TRANSFER_DST_BIT;

Result<BufferObject*> checked_range(const Device* device, const Buffer& buffer, std::size_t bytes, std::size_t offset) {
  if (!buffer) return internal_error("gpu: data moved to or from an empty buffer");
  BufferObject& object = *buffer.impl()->object;
  if (object.device.get() != device) return internal_error("gpu: a buffer of another device");
  if (offset > buffer.size() || bytes > buffer.size() - offset)
    return internal_error(
        fmt::format("gpu: bytes {}..{} of a buffer of {} bytes", offset, offset + bytes, buffer.size()));
  return &object;
}

using MovePiece = std::function<Result<void>(Staging& staging, std::size_t done, std::size_t bytes)>;

// Moves `bytes` in pieces no larger than the staging buffer may be.
Result<void> in_pieces(Device::Impl& device, std::size_t bytes, const MovePiece& move) {
  for (std::size_t done = 0; done < bytes; done += k_staging_limit) {
    const std::size_t piece = std::min(bytes - done, k_staging_limit);
    CUTICLE_ASSIGN(Staging * staging, staging_of(device, piece));
    CUTICLE_TRY(move(*staging, done, piece));
  }
  return {};
}

Result<void> copy_now(Device::Impl& device, VkBuffer from, VkBuffer to, const VkBufferCopy& region) {
  return run_now(device, [&](VkCommandBuffer commands) { device.vk.vkCmdCopyBuffer(commands, from, to, 1, &region); });
}

Result<void> create_buffer(BufferObject& object) {
  Device::Impl& device = *object.device->impl();
  CUTICLE_ASSIGN(object.handle, create_buffer_handle(device, object.size, k_usage));
  VkMemoryRequirements needs{};
  device.vk.vkGetBufferMemoryRequirements(device.device, object.handle, &needs);
  CUTICLE_ASSIGN(object.memory, allocate(device, needs, MemoryUse::device));
  count_allocated(device, object.memory.bytes);
  return checked(device.vk.vkBindBufferMemory(device.device, object.handle, object.memory.handle, 0),
                 "vkBindBufferMemory");
}

}  // namespace

Buffer::Buffer() = default;
Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
std::size_t Buffer::size() const { return impl_ ? impl_->bytes : 0; }

Buffer part_of(const Buffer& buffer, std::size_t offset, std::size_t bytes) {
  CUTICLE_EXPECT(buffer && offset % k_part_alignment == 0 && offset <= buffer.size() && bytes <= buffer.size() - offset,
                 "a part lies within its buffer");
  Buffer part;
  part.impl_ =
      std::make_unique<Buffer::Impl>(Buffer::Impl{buffer.impl()->object, buffer.impl()->offset + offset, bytes});
  return part;
}

BufferObject::~BufferObject() {
  Device::Impl& owner = *device->impl();
  owner.vk.vkDestroyBuffer(owner.device, handle, nullptr);
  owner.allocated -= memory.bytes;
  release(owner, memory);
}

Result<VkBuffer> create_buffer_handle(Device::Impl& device, std::size_t bytes, VkBufferUsageFlags usage) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  VkBuffer buffer = VK_NULL_HANDLE;
  CUTICLE_TRY(checked(device.vk.vkCreateBuffer(device.device, &info, nullptr, &buffer), "vkCreateBuffer"));
  return buffer;
}

Result<Buffer> Device::make_buffer(std::size_t bytes) { return make_up_to(bytes, info().max_storage_buffer_bytes); }
Result<Buffer> Device::make_texel_buffer(std::size_t bytes, TextureFormat format) {
  return make_up_to(bytes, info().max_texel_buffer_bytes / 16 * bytes_per_texel(format));
}

Result<Buffer> Device::make_up_to(std::size_t bytes, std::uint64_t most) {
  if (bytes > most)
    return out_of_memory_error(
        fmt::format("a buffer of {} bytes: {} allows at most {} bytes in one buffer", bytes, info().name, most),
        "use fewer strands, smaller pictures or smaller grids");
  auto object = std::make_shared<BufferObject>();
  object->device = shared_from_this();
  object->size = std::max(bytes, k_smallest_buffer);
  CUTICLE_TRY(create_buffer(*object));
  Buffer buffer;
  const std::size_t size = object->size;
  buffer.impl_ = std::make_unique<Buffer::Impl>(Buffer::Impl{std::move(object), 0, size});
  return buffer;
}

Result<void> Device::upload(const Buffer& buffer, std::span<const std::byte> data, std::size_t offset) {
  CUTICLE_ASSIGN(BufferObject * object, checked_range(this, buffer, data.size(), offset));
  if (data.empty()) return {};
  offset += buffer.impl()->offset;
  if (object->memory.mapped) {
    std::memcpy(object->memory.mapped + offset, data.data(), data.size());
    return {};
  }
  return in_pieces(*impl_, data.size(), [&](Staging& staging, std::size_t done, std::size_t bytes) -> Result<void> {
    std::memcpy(staging.memory.mapped, data.data() + done, bytes);
    return copy_now(*impl_, staging.buffer, object->handle, {0, offset + done, bytes});
  });
}

Result<void> Device::download(const Buffer& buffer, std::span<std::byte> data, std::size_t offset) {
  CUTICLE_ASSIGN(BufferObject * object, checked_range(this, buffer, data.size(), offset));
  if (data.empty()) return {};
  offset += buffer.impl()->offset;
  if (object->memory.mapped) {
    std::memcpy(data.data(), object->memory.mapped + offset, data.size());
    return {};
  }
  return in_pieces(*impl_, data.size(), [&](Staging& staging, std::size_t done, std::size_t bytes) -> Result<void> {
    CUTICLE_TRY(copy_now(*impl_, object->handle, staging.buffer, {offset + done, 0, bytes}));
    std::memcpy(data.data() + done, staging.memory.mapped, bytes);
    return {};
  });
}

}  // namespace cuticle::gpu
