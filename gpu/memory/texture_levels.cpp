#include <algorithm>
#include <bit>

#include "gpu/detail/commands_impl.h"
#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

VkImageBlit halving(const TextureDescription& description, std::uint32_t level) {
  const auto side = [](int first, std::uint32_t at) { return std::max(1, first >> at); };
  VkImageBlit blit{};
  blit.srcSubresource = {aspect_of(description.format), level - 1, 0, 1};
  blit.dstSubresource = {aspect_of(description.format), level, 0, 1};
  blit.srcOffsets[1] = {side(description.size.x, level - 1), side(description.size.y, level - 1), 1};
  blit.dstOffsets[1] = {side(description.size.x, level), side(description.size.y, level), 1};
  return blit;
}

}  // namespace

std::uint32_t level_count(const TextureDescription& description) {
  return description.mip_levels ? std::uint32_t(std::bit_width(unsigned(std::max(description.size.x, description.size.y))))
                                : 1;
}

void record_levels(Device::Impl& device, VkCommandBuffer commands, const TextureObject& object) {
  for (std::uint32_t level = 1; level < level_count(object.description); ++level) {
    full_barrier(device, commands);
    const VkImageBlit blit = halving(object.description, level);
    device.vk.vkCmdBlitImage(commands, object.image, VK_IMAGE_LAYOUT_GENERAL, object.image, VK_IMAGE_LAYOUT_GENERAL, 1,
                             &blit, VK_FILTER_LINEAR);
  }
}

}  // namespace cuticle::gpu
