#include "gpu/detail/pipeline.h"

namespace cuticle::gpu {

Kernel::Kernel() = default;
Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;

namespace {

Result<std::shared_ptr<PipelineObject>> make_pipeline(Device::Impl& device, std::span<const std::uint32_t> spirv,
                                                      const ShaderInterface& interface) {
  CUTICLE_ASSIGN(auto object, make_layout(device, interface, VK_SHADER_STAGE_COMPUTE_BIT));
  const ShaderModule shader(device, spirv);
  CUTICLE_TRY(checked(shader.result, "vkCreateShaderModule"));
  const Specialization specialization(interface);
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage = shader_stage(VK_SHADER_STAGE_COMPUTE_BIT, shader, specialization);
  info.layout = object->layout;
  CUTICLE_TRY(
      checked(device.vk.vkCreateComputePipelines(device.device, VK_NULL_HANDLE, 1, &info, nullptr, &object->pipeline),
              "vkCreateComputePipelines"));
  return object;
}

}  // namespace

Result<Kernel> Device::make_kernel(std::span<const std::uint32_t> spirv, const ShaderInterface& interface) {
  ContentKey key;
  key.add(spirv);
  add_interface(key, interface);
  CUTICLE_ASSIGN(auto object, shared_pipeline(*impl_, key, [&] { return make_pipeline(*impl_, spirv, interface); }));
  Kernel kernel;
  kernel.impl_ = std::make_unique<Kernel::Impl>(Kernel::Impl{shared_from_this(), std::move(object)});
  return kernel;
}

}  // namespace cuticle::gpu
