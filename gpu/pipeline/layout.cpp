#include <algorithm>

#include <fmt/format.h>

#include "gpu/detail/pipeline.h"

namespace cuticle::gpu {
namespace {

Result<void> within(std::string_view what, std::uint32_t count, std::uint32_t limit) {
  if (count <= limit) return {};
  return bad_input(fmt::format("a shader with {} {}: the device allows 0..{}", count, what, limit));
}

Result<void> check_limits(const Device::Impl& device, const ShaderInterface& interface) {
  CUTICLE_TRY(within("bytes of push constants", interface.push_constant_bytes, 128));
  CUTICLE_EXPECT(std::ranges::all_of(interface.texels,
                                     [&](const TexelBinding& texel) {
                                       return texel.binding < interface.storage_buffers &&
                                              texel.format != TextureFormat::rgba8 &&
                                              texel.format != TextureFormat::depth32f;
                                     }),
                 "texels are read from a buffer, in a format that every device reads there");
  CUTICLE_TRY(within("storage buffers", interface.storage_buffers, device.limits.maxPerStageDescriptorStorageBuffers));
  return within("textures", interface.textures, device.limits.maxPerStageDescriptorSampledImages);
}

std::vector<VkDescriptorSetLayoutBinding> bindings_of(const PipelineObject& object) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  const ShaderInterface& interface = object.interface;
  for (std::uint32_t i = 0; i < interface.storage_buffers + interface.textures; ++i)
    bindings.push_back(
        {i,
         i < interface.storage_buffers ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
         1, object.stages, nullptr});
  for (const TexelBinding& texel : interface.texels)
    bindings[texel.binding].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
  return bindings;
}

Result<void> create_set_layout(PipelineObject& object) {
  Device::Impl& device = *object.device;
  const std::vector<VkDescriptorSetLayoutBinding> bindings = bindings_of(object);
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = std::uint32_t(bindings.size());
  info.pBindings = bindings.data();
  return checked(device.vk.vkCreateDescriptorSetLayout(device.device, &info, nullptr, &object.set_layout),
                 "vkCreateDescriptorSetLayout");
}

Result<void> create_pipeline_layout(PipelineObject& object) {
  Device::Impl& device = *object.device;
  const VkPushConstantRange range{object.stages, 0, object.interface.push_constant_bytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &object.set_layout;
  info.pushConstantRangeCount = range.size > 0 ? 1 : 0;
  info.pPushConstantRanges = &range;
  return checked(device.vk.vkCreatePipelineLayout(device.device, &info, nullptr, &object.layout),
                 "vkCreatePipelineLayout");
}

}  // namespace

PipelineObject::~PipelineObject() {
  device->vk.vkDestroyPipeline(device->device, pipeline, nullptr);
  device->vk.vkDestroyPipelineLayout(device->device, layout, nullptr);
  device->vk.vkDestroyDescriptorSetLayout(device->device, set_layout, nullptr);
}

void add_interface(ContentKey& key, const ShaderInterface& interface) {
  key.add(interface.storage_buffers);
  key.add(interface.textures);
  key.add(interface.push_constant_bytes);
  key.add(std::span<const std::uint32_t>(interface.specialization));
  key.add(interface.texels.size());
  for (const TexelBinding& texel : interface.texels) {
    key.add(texel.binding);
    key.add(int(texel.format));
  }
}

Result<std::shared_ptr<PipelineObject>> make_layout(Device::Impl& device, const ShaderInterface& interface,
                                                    VkShaderStageFlags stages) {
  CUTICLE_TRY(check_limits(device, interface));
  auto object = std::make_shared<PipelineObject>();
  object->device = &device;
  object->interface = interface;
  object->stages = stages;
  CUTICLE_TRY(create_set_layout(*object));
  CUTICLE_TRY(create_pipeline_layout(*object));
  return object;
}

}  // namespace cuticle::gpu
