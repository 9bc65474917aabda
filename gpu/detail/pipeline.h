#pragma once
// Private to gpu/ (not installed): pipelines with their layouts.
#include <array>

#include "core/content_key.h"
#include "gpu/detail/device_impl.h"

namespace cuticle::gpu {

/// Shared by all that asked for the same; the device, which outlives it, keeps it for those who ask again.
struct PipelineObject {
  Device::Impl* device = nullptr;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  ShaderInterface interface;
  VkShaderStageFlags stages = 0;
  ~PipelineObject();
};
struct Kernel::Impl {
  std::shared_ptr<Device> device;
  std::shared_ptr<PipelineObject> object;
};
struct GraphicsPipeline::Impl {
  std::shared_ptr<Device> device;
  std::shared_ptr<PipelineObject> object;
};

/// A PipelineObject with its layouts, still without a pipeline. Error: bad_input past a limit of the device.
Result<std::shared_ptr<PipelineObject>> make_layout(Device::Impl& device, const ShaderInterface& interface,
                                                    VkShaderStageFlags stages);

/// The device's pipeline with this key, which stands for all that `make` makes it of; made where there is none.
template <class Make>
Result<std::shared_ptr<PipelineObject>> shared_pipeline(Device::Impl& device, const ContentKey& key, const Make& make) {
  std::shared_ptr<PipelineObject> object = device.pipelines.find(key.value());
  if (object) return object;
  CUTICLE_ASSIGN(object, make());
  device.pipelines.keep(key.value(), object);
  return object;
}

/// What a pipeline's interface adds to its key.
void add_interface(ContentKey& key, const ShaderInterface& interface);

/// A shader module, destroyed at the end of the scope (a pipeline does not need it after its creation).
class ShaderModule {
 public:
  ShaderModule(Device::Impl& device, std::span<const std::uint32_t> spirv);
  ~ShaderModule();
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;
  VkShaderModule handle = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;

 private:
  Device::Impl& device_;
};

/// Specialization constants 0, 1, 2, ... of an interface; alive as long as the pipeline is being created.
struct Specialization {
  explicit Specialization(const ShaderInterface& interface);
  std::vector<VkSpecializationMapEntry> entries;
  VkSpecializationInfo info{};
};
VkPipelineShaderStageCreateInfo shader_stage(VkShaderStageFlagBits stage, const ShaderModule& shader,
                                             const Specialization& specialization);

}  // namespace cuticle::gpu
