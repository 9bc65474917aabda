#include <algorithm>

#include <fmt/format.h>

#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

Result<void> check_size(const DeviceInfo& info, glm::ivec2 size) {
  const int limit = int(info.max_image_size);
  if (size.x >= 1 && size.y >= 1 && size.x <= limit && size.y <= limit) return {};
  return bad_input(fmt::format("a texture of {} x {}: {} allows 1..{} a side", size.x, size.y, info.name, limit));
}

VkImageUsageFlags usage_of(const TextureDescription& description) {
  const VkImageUsageFlags target = description.format == TextureFormat::depth32f
                                       ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                       : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (description.samples > 1) return target | (description.read_samples ? VK_IMAGE_USAGE_SAMPLED_BIT : 0);
  const VkImageUsageFlags sampled =
      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return sampled | (description.render_target ? target : 0);
}

/// The counts that the device offers for this format, used so.
std::vector<int> offered_samples(const Device::Impl& device, const TextureDescription& description) {
  VkImageFormatProperties offered{};
  vkGetPhysicalDeviceImageFormatProperties(device.physical, vulkan_format(description.format), VK_IMAGE_TYPE_2D,
                                           VK_IMAGE_TILING_OPTIMAL, usage_of(description), 0, &offered);
  std::vector<int> counts;
  for (int count : device.info.sample_counts)
    if (offered.sampleCounts & VkSampleCountFlags(count)) counts.push_back(count);
  return counts;
}

Result<void> check_samples(const Device::Impl& device, const TextureDescription& description) {
  const std::vector<int> offered =
      description.samples > 1 ? offered_samples(device, description) : device.info.sample_counts;
  if (std::find(offered.begin(), offered.end(), description.samples) == offered.end())
    return bad_input(fmt::format("{} samples a pixel: {} offers {}", description.samples, device.info.name,
                                 fmt::join(offered, ", ")));
  if (description.samples > 1 && !description.render_target)
    return internal_error("gpu: a multisampled texture that is no render target");
  return {};
}

VkFormatFeatureFlags needed_features(const TextureDescription& description) {
  VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
  if (description.filter == Filter::linear) needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  if (description.mip_levels) needed |= VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT;
  if (!description.render_target) return needed;
  return needed | (description.format == TextureFormat::depth32f ? VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                                 : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT);
}

Result<void> check_format(const Device::Impl& device, const TextureDescription& description) {
  VkFormatProperties offered{};
  vkGetPhysicalDeviceFormatProperties(device.physical, vulkan_format(description.format), &offered);
  const VkFormatFeatureFlags needed = needed_features(description);
  if ((offered.optimalTilingFeatures & needed) == needed) return {};
  return bad_input(fmt::format("{} cannot sample, filter or render to texture format {} as asked for", device.info.name,
                               int(description.format)),
                   "use Filter::nearest or rgba16f");
}

Result<void> check_levels(const TextureDescription& description) {
  if (!description.mip_levels || (description.samples == 1 && !description.render_target &&
                                  description.filter == Filter::linear))
    return {};
  return internal_error("gpu: mip levels of a render target, or of a texture that is not filtered");
}

Result<void> create_image(TextureObject& object) {
  Device::Impl& device = *object.device->impl();
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = vulkan_format(object.description.format);
  info.extent = {std::uint32_t(object.description.size.x), std::uint32_t(object.description.size.y), 1};
  info.mipLevels = level_count(object.description);
  info.arrayLayers = 1;
  info.samples = VkSampleCountFlagBits(object.description.samples);
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage_of(object.description);
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  return checked(device.vk.vkCreateImage(device.device, &info, nullptr, &object.image), "vkCreateImage");
}

Result<void> create_image_memory(TextureObject& object) {
  Device::Impl& device = *object.device->impl();
  VkMemoryRequirements needs{};
  device.vk.vkGetImageMemoryRequirements(device.device, object.image, &needs);
  CUTICLE_ASSIGN(object.memory, allocate(device, needs, MemoryUse::device));
  count_allocated(device, object.memory.bytes);
  return checked(device.vk.vkBindImageMemory(device.device, object.image, object.memory.handle, 0),
                 "vkBindImageMemory");
}

Result<void> create_view(TextureObject& object) {
  Device::Impl& device = *object.device->impl();
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = object.image;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = vulkan_format(object.description.format);
  info.subresourceRange = {aspect_of(object.description.format), 0, level_count(object.description), 0, 1};
  return checked(device.vk.vkCreateImageView(device.device, &info, nullptr, &object.view), "vkCreateImageView");
}

Result<void> create_sampler(TextureObject& object) {
  Device::Impl& device = *object.device->impl();
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = info.minFilter = object.description.filter == Filter::linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  if (object.description.mip_levels) {
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.maxLod = VK_LOD_CLAMP_NONE;
  }
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  return checked(device.vk.vkCreateSampler(device.device, &info, nullptr, &object.sampler), "vkCreateSampler");
}

// Every texture stays in the general layout from its creation on, so recorded work needs no layout of its own.
Result<void> enter_general_layout(TextureObject& object) {
  Device::Impl& device = *object.device->impl();
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = object.image;
  barrier.subresourceRange = {aspect_of(object.description.format), 0, level_count(object.description), 0, 1};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  return run_now(device, [&](VkCommandBuffer commands) { device.vk.vkCmdPipelineBarrier2(commands, &dependency); });
}

}  // namespace

Texture::Texture() = default;
Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;
glm::ivec2 Texture::size() const { return impl_ ? impl_->object->description.size : glm::ivec2(0); }
TextureFormat Texture::format() const { return impl_ ? impl_->object->description.format : TextureFormat::rgba16f; }
int Texture::samples() const { return impl_ ? impl_->object->description.samples : 0; }

TextureObject::~TextureObject() {
  Device::Impl& owner = *device->impl();
  owner.vk.vkDestroySampler(owner.device, sampler, nullptr);
  owner.vk.vkDestroyImageView(owner.device, view, nullptr);
  owner.vk.vkDestroyImage(owner.device, image, nullptr);
  owner.allocated -= memory.bytes;
  release(owner, memory);
}

Result<Texture> Device::make_texture(const TextureDescription& description) {
  CUTICLE_TRY(check_size(info(), description.size));
  CUTICLE_TRY(check_samples(*impl_, description));
  CUTICLE_TRY(check_levels(description));
  CUTICLE_TRY(check_format(*impl_, description));
  auto object = std::make_shared<TextureObject>();
  object->device = shared_from_this();
  object->description = description;
  CUTICLE_TRY(create_image(*object));
  CUTICLE_TRY(create_image_memory(*object));
  CUTICLE_TRY(create_view(*object));
  CUTICLE_TRY(create_sampler(*object));
  CUTICLE_TRY(enter_general_layout(*object));
  Texture texture;
  texture.impl_ = std::make_unique<Texture::Impl>(Texture::Impl{std::move(object)});
  return texture;
}

}  // namespace cuticle::gpu
