#include <algorithm>

#include <fmt/format.h>

#include "gpu/detail/commands_impl.h"
#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

constexpr std::uint32_t k_sets_per_pool = 64;

Result<VkDescriptorPool> create_descriptor_pool(Device::Impl& device) {
  const std::array<VkDescriptorPoolSize, 3> sizes{{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8 * k_sets_per_pool},
                                                   {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 8 * k_sets_per_pool},
                                                   {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4 * k_sets_per_pool}}};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = k_sets_per_pool;
  info.poolSizeCount = std::uint32_t(sizes.size());
  info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  CUTICLE_TRY(
      checked(device.vk.vkCreateDescriptorPool(device.device, &info, nullptr, &pool), "vkCreateDescriptorPool"));
  return pool;
}

VkResult allocate_from(Device::Impl& device, VkDescriptorPool pool, VkDescriptorSetLayout layout,
                       VkDescriptorSet& set) {
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  return device.vk.vkAllocateDescriptorSets(device.device, &info, &set);
}

bool fits(Commands::Impl& commands, const ShaderInterface& interface, const Resources& resources) {
  if (resources.buffers.size() == interface.storage_buffers && resources.textures.size() == interface.textures &&
      resources.push_constants.size() == interface.push_constant_bytes)
    return true;
  fail(commands, internal_error(fmt::format(
                     "gpu: given {} buffers, {} textures, {} bytes of push constants to a shader of {}, {}, {}",
                     resources.buffers.size(), resources.textures.size(), resources.push_constants.size(),
                     interface.storage_buffers, interface.textures, interface.push_constant_bytes)));
  return false;
}

// The descriptors of one set; the infos must stand still while the writes point at them.
struct Writes {
  std::vector<VkDescriptorBufferInfo> buffers;
  std::vector<VkDescriptorImageInfo> images;
  std::vector<std::pair<std::uint32_t, VkBufferView>> texels;  // by binding
  std::vector<VkWriteDescriptorSet> writes;
};

VkWriteDescriptorSet write_of(VkDescriptorSet set, std::size_t binding, VkDescriptorType type) {
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set;
  write.dstBinding = std::uint32_t(binding);
  write.descriptorCount = 1;
  write.descriptorType = type;
  return write;
}

VkBufferView view_of(Commands::Impl& commands, const Buffer::Impl& buffer, TextureFormat format) {
  Device::Impl& device = *commands.device->impl();
  const std::size_t texels = buffer.bytes / bytes_per_texel(format);
  if (texels > device.limits.maxTexelBufferElements)
    return fail(commands, bad_input(fmt::format("gpu: a buffer of {} texels: the device allows 0..{}", texels,
                                                device.limits.maxTexelBufferElements))),
           VK_NULL_HANDLE;
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = buffer.object->handle;
  info.offset = buffer.offset;
  info.format = vulkan_format(format);
  info.range = texels * bytes_per_texel(format);
  VkBufferView view = VK_NULL_HANDLE;
  if (const VkResult result = device.vk.vkCreateBufferView(device.device, &info, nullptr, &view); result != VK_SUCCESS)
    return fail(commands, vulkan_error(result, "vkCreateBufferView")), VK_NULL_HANDLE;
  commands.buffer_views.push_back(view);
  return view;
}

bool collect_texels(Commands::Impl& commands, const ShaderInterface& interface, const Resources& resources,
                    Writes& writes) {
  for (const TexelBinding& texel : interface.texels) {
    writes.texels.emplace_back(texel.binding,
                               view_of(commands, *resources.buffers[texel.binding]->impl(), texel.format));
    if (writes.texels.back().second == VK_NULL_HANDLE) return false;
  }
  return true;
}

/// Whether a buffer may be bound: as storage only up to the device's limit, above which it is read as texels.
bool may_bind(Commands::Impl& commands, const ShaderInterface& interface, std::size_t binding, std::size_t bytes) {
  const bool has_texels =
      std::ranges::any_of(interface.texels, [&](const TexelBinding& texel) { return texel.binding == binding; });
  const std::uint32_t most = commands.device->impl()->limits.maxStorageBufferRange;
  if (has_texels || bytes <= most) return true;
  fail(commands, internal_error(fmt::format("gpu: binding {}: {} bytes as storage, the device allows {}: bind a part, "
                                            "or read texels",
                                            binding, bytes, most)));
  return false;
}

bool collect(Commands::Impl& commands, const ShaderInterface& interface, const Resources& resources, Writes& writes) {
  for (const Buffer* buffer : resources.buffers) {
    const auto object = object_of(commands, buffer);
    if (!object || !may_bind(commands, interface, writes.buffers.size(), buffer->impl()->bytes)) return false;
    writes.buffers.push_back({object->handle, buffer->impl()->offset, buffer->impl()->bytes});
  }
  for (const Texture* texture : resources.textures) {
    const auto object = object_of(commands, texture);
    if (!object) return false;
    writes.images.push_back({object->sampler, object->view, VK_IMAGE_LAYOUT_GENERAL});
  }
  return true;
}

void write_set(Device::Impl& device, VkDescriptorSet set, Writes& writes) {
  for (const VkDescriptorBufferInfo& buffer : writes.buffers) {
    writes.writes.push_back(write_of(set, writes.writes.size(), VK_DESCRIPTOR_TYPE_STORAGE_BUFFER));
    writes.writes.back().pBufferInfo = &buffer;
  }
  for (const VkDescriptorImageInfo& image : writes.images) {
    writes.writes.push_back(write_of(set, writes.writes.size(), VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER));
    writes.writes.back().pImageInfo = &image;
  }
  for (const auto& [binding, view] : writes.texels) {
    writes.writes[binding] = write_of(set, binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    writes.writes[binding].pTexelBufferView = &view;
  }
  device.vk.vkUpdateDescriptorSets(device.device, std::uint32_t(writes.writes.size()), writes.writes.data(), 0,
                                   nullptr);
}

}  // namespace

VkDescriptorSet allocate_set(Commands::Impl& commands, VkDescriptorSetLayout layout) {
  Device::Impl& device = *commands.device->impl();
  VkDescriptorSet set = VK_NULL_HANDLE;
  if (!commands.descriptor_pools.empty() &&
      allocate_from(device, commands.descriptor_pools.back(), layout, set) == VK_SUCCESS)
    return set;
  auto pool = create_descriptor_pool(device);
  if (!pool) return fail(commands, pool.error()), VK_NULL_HANDLE;
  commands.descriptor_pools.push_back(*pool);
  if (const VkResult result = allocate_from(device, *pool, layout, set); result != VK_SUCCESS)
    fail(commands, vulkan_error(result, "vkAllocateDescriptorSets"));
  return set;
}

bool bind(Commands::Impl& commands, VkPipelineBindPoint point, const std::shared_ptr<PipelineObject>& pipeline,
          const Resources& resources) {
  Device::Impl& device = *commands.device->impl();
  Writes writes;
  const ShaderInterface& interface = pipeline->interface;
  if (!fits(commands, interface, resources) || !collect(commands, interface, resources, writes) ||
      !collect_texels(commands, interface, resources, writes))
    return false;
  const VkDescriptorSet set = allocate_set(commands, pipeline->set_layout);
  if (set == VK_NULL_HANDLE) return false;
  write_set(device, set, writes);
  commands.used.push_back(pipeline);
  device.vk.vkCmdBindPipeline(commands.buffer, point, pipeline->pipeline);
  device.vk.vkCmdBindDescriptorSets(commands.buffer, point, pipeline->layout, 0, 1, &set, 0, nullptr);
  if (!resources.push_constants.empty())
    device.vk.vkCmdPushConstants(commands.buffer, pipeline->layout, pipeline->stages, 0,
                                 std::uint32_t(resources.push_constants.size()), resources.push_constants.data());
  return true;
}

}  // namespace cuticle::gpu
