#include "gpu/detail/pipeline.h"

namespace cuticle::gpu {

ShaderModule::ShaderModule(Device::Impl& device, std::span<const std::uint32_t> spirv) : device_(device) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = spirv.size_bytes();
  info.pCode = spirv.data();
  result = device_.vk.vkCreateShaderModule(device_.device, &info, nullptr, &handle);
}

ShaderModule::~ShaderModule() { device_.vk.vkDestroyShaderModule(device_.device, handle, nullptr); }

Specialization::Specialization(const ShaderInterface& interface) {
  for (std::uint32_t i = 0; i < interface.specialization.size(); ++i)
    entries.push_back({i, std::uint32_t(i * sizeof(std::uint32_t)), sizeof(std::uint32_t)});
  info.mapEntryCount = std::uint32_t(entries.size());
  info.pMapEntries = entries.data();
  info.dataSize = interface.specialization.size() * sizeof(std::uint32_t);
  info.pData = interface.specialization.data();
}

VkPipelineShaderStageCreateInfo shader_stage(VkShaderStageFlagBits stage, const ShaderModule& shader,
                                             const Specialization& specialization) {
  VkPipelineShaderStageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = stage;
  info.module = shader.handle;
  info.pName = "main";
  info.pSpecializationInfo = &specialization.info;
  return info;
}

}  // namespace cuticle::gpu
