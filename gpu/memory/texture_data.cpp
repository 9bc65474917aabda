#include <algorithm>

#include <fmt/format.h>

#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

Result<TextureObject*> checked_texture(const Device* device, const Texture& texture) {
  if (!texture) return internal_error("gpu: data moved to or from an empty texture");
  TextureObject& object = *texture.impl()->object;
  if (object.device.get() != device) return internal_error("gpu: a texture of another device");
  if (object.description.samples > 1)
    return internal_error("gpu: data moved to or from a multisampled texture; resolve it");
  return &object;
}

// Rows [begin, end) that pass through the staging buffer at once.
std::vector<Chunk> row_chunks(const TextureDescription& description) {
  const std::size_t row = std::size_t(description.size.x) * bytes_per_texel(description.format);
  return chunks(std::size_t(description.size.y), row, k_staging_limit);
}

VkBufferImageCopy region_of(const TextureDescription& description, const Chunk& rows) {
  VkBufferImageCopy region{};
  region.imageSubresource = {aspect_of(description.format), 0, 0, 1};
  region.imageOffset = {0, int(rows.begin), 0};
  region.imageExtent = {std::uint32_t(description.size.x), std::uint32_t(rows.end - rows.begin), 1};
  return region;
}

std::size_t texels_in(const TextureDescription& description, const Chunk& rows) {
  return std::size_t(description.size.x) * (rows.end - rows.begin);
}

std::span<std::byte> staged(Staging& staging, const TextureDescription& description, const Chunk& rows) {
  return {staging.memory.mapped, texels_in(description, rows) * bytes_per_texel(description.format)};
}

}  // namespace

Result<void> Device::upload(const Texture& texture, std::span<const float> data) {
  CUTICLE_ASSIGN(TextureObject * object, checked_texture(this, texture));
  const TextureDescription& description = object->description;
  const std::size_t row = std::size_t(description.size.x) * floats_per_texel(description.format);
  if (data.size() != row * std::size_t(description.size.y))
    return internal_error(
        fmt::format("gpu: {} floats for a texture of {}", data.size(), row * std::size_t(description.size.y)));
  for (const Chunk& rows : row_chunks(description)) {
    CUTICLE_ASSIGN(Staging * staging,
                   staging_of(*impl_, texels_in(description, rows) * bytes_per_texel(description.format)));
    texels_from_floats(description.format, data.subspan(rows.begin * row, (rows.end - rows.begin) * row),
                       staged(*staging, description, rows));
    const VkBufferImageCopy region = region_of(description, rows);
    CUTICLE_TRY(run_now(*impl_, [&](VkCommandBuffer commands) {
      impl_->vk.vkCmdCopyBufferToImage(commands, staging->buffer, object->image, VK_IMAGE_LAYOUT_GENERAL, 1, &region);
    }));
  }
  if (!description.mip_levels) return {};
  return run_now(*impl_, [&](VkCommandBuffer commands) { record_levels(*impl_, commands, *object); });
}

Result<std::vector<float>> Device::download(const Texture& texture) {
  CUTICLE_ASSIGN(TextureObject * object, checked_texture(this, texture));
  const TextureDescription& description = object->description;
  const std::size_t row = std::size_t(description.size.x) * floats_per_texel(description.format);
  std::vector<float> data(row * std::size_t(description.size.y));
  for (const Chunk& rows : row_chunks(description)) {
    CUTICLE_ASSIGN(Staging * staging,
                   staging_of(*impl_, texels_in(description, rows) * bytes_per_texel(description.format)));
    const VkBufferImageCopy region = region_of(description, rows);
    CUTICLE_TRY(run_now(*impl_, [&](VkCommandBuffer commands) {
      impl_->vk.vkCmdCopyImageToBuffer(commands, object->image, VK_IMAGE_LAYOUT_GENERAL, staging->buffer, 1, &region);
    }));
    floats_from_texels(description.format, staged(*staging, description, rows),
                       std::span(data).subspan(rows.begin * row, (rows.end - rows.begin) * row));
  }
  return data;
}

}  // namespace cuticle::gpu
