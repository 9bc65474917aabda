#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "gpu/detail/pipeline.h"
#include "gpu/detail/texels.h"

namespace cuticle::gpu {
namespace {

constexpr VkShaderStageFlags k_stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkPipelineColorBlendAttachmentState blend_of(BlendMode mode) {
  VkPipelineColorBlendAttachmentState state{};
  state.colorWriteMask =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  state.blendEnable = mode != BlendMode::none;
  const bool alpha = mode == BlendMode::alpha;
  state.srcColorBlendFactor = alpha ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = state.dstAlphaBlendFactor =
      alpha ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  return state;
}

VkCompareOp compare_of(DepthCompare compare) {
  if (compare == DepthCompare::equal) return VK_COMPARE_OP_EQUAL;
  return compare == DepthCompare::less ? VK_COMPARE_OP_LESS : VK_COMPARE_OP_LESS_OR_EQUAL;
}

bool has_depth(const GraphicsDescription& description) {
  return description.depth_test || description.depth_write || description.depth_target;
}

// The fixed-function state of a pipeline; its members point at each other, so it does not move.
struct FixedState {
  VkPipelineVertexInputStateCreateInfo vertex{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationStateCreateInfo raster{};
  VkPipelineMultisampleStateCreateInfo multisample{};
  VkPipelineDepthStencilStateCreateInfo depth{};
  std::vector<VkPipelineColorBlendAttachmentState> blends;
  VkPipelineColorBlendStateCreateInfo blend{};
  std::array<VkDynamicState, 2> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  std::vector<VkFormat> formats;
  VkPipelineRenderingCreateInfo rendering{};

  FixedState(const GraphicsDescription& description, bool wide_lines);
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;

 private:
  void set_geometry(const GraphicsDescription& description, bool wide_lines);
  void set_depth(const GraphicsDescription& description);
  void set_targets(const GraphicsDescription& description);
};

FixedState::FixedState(const GraphicsDescription& description, bool wide_lines) {
  set_geometry(description, wide_lines);
  set_depth(description);
  set_targets(description);
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = std::uint32_t(dynamic_states.size());
  dynamic.pDynamicStates = dynamic_states.data();
}

void FixedState::set_geometry(const GraphicsDescription& description, bool wide_lines) {
  vertex.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology =
      description.topology == Topology::lines ? VK_PRIMITIVE_TOPOLOGY_LINE_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = viewport.scissorCount = 1;
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.cullMode = VkCullModeFlags(description.cull_back_faces ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE) |
                    VkCullModeFlags(description.cull_front_faces ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_NONE);
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  raster.lineWidth = wide_lines ? description.line_width : 1.0f;
}

void FixedState::set_depth(const GraphicsDescription& description) {
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  // Without the test enabled Vulkan writes no depth either.
  depth.depthTestEnable = description.depth_test || description.depth_write;
  depth.depthCompareOp = description.depth_test ? compare_of(description.depth_compare) : VK_COMPARE_OP_ALWAYS;
  depth.depthWriteEnable = description.depth_write;
}

void FixedState::set_targets(const GraphicsDescription& description) {
  multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  multisample.rasterizationSamples = VkSampleCountFlagBits(description.samples);
  blends.assign(description.color_formats.size(), blend_of(description.blend));
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = std::uint32_t(blends.size());
  blend.pAttachments = blends.data();
  for (TextureFormat format : description.color_formats) formats.push_back(vulkan_format(format));
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = std::uint32_t(formats.size());
  rendering.pColorAttachmentFormats = formats.data();
  rendering.depthAttachmentFormat = has_depth(description) ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_UNDEFINED;
}

VkGraphicsPipelineCreateInfo create_info(const FixedState& state,
                                         std::span<const VkPipelineShaderStageCreateInfo> stages,
                                         VkPipelineLayout layout) {
  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &state.rendering;
  info.stageCount = std::uint32_t(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &state.vertex;
  info.pInputAssemblyState = &state.assembly;
  info.pViewportState = &state.viewport;
  info.pRasterizationState = &state.raster;
  info.pMultisampleState = &state.multisample;
  info.pDepthStencilState = &state.depth;
  info.pColorBlendState = &state.blend;
  info.pDynamicState = &state.dynamic;
  info.layout = layout;
  return info;
}

Result<void> check(const Device::Impl& device, const GraphicsDescription& description) {
  const auto& offered = device.info.sample_counts;
  if (std::find(offered.begin(), offered.end(), description.samples) == offered.end())
    return bad_input(fmt::format("{} samples a pixel: {} offers {}", description.samples, device.info.name,
                                 fmt::join(offered, ", ")));
  const float* width = device.limits.lineWidthRange;
  if (device.info.wide_lines && !(description.line_width >= width[0] && description.line_width <= width[1]))
    return bad_input(fmt::format("lines {} pixels wide: {} allows {}..{}", description.line_width, device.info.name,
                                 width[0], width[1]));
  return {};
}

Result<void> create_pipeline(PipelineObject& object, const GraphicsDescription& description) {
  Device::Impl& device = *object.device;
  const Specialization specialization(object.interface);
  const ShaderModule vertex(device, description.vertex_spirv);
  CUTICLE_TRY(checked(vertex.result, "vkCreateShaderModule (vertex)"));
  std::vector stages{shader_stage(VK_SHADER_STAGE_VERTEX_BIT, vertex, specialization)};
  std::optional<ShaderModule> fragment;
  if (!description.fragment_spirv.empty()) {
    fragment.emplace(device, description.fragment_spirv);
    CUTICLE_TRY(checked(fragment->result, "vkCreateShaderModule (fragment)"));
    stages.push_back(shader_stage(VK_SHADER_STAGE_FRAGMENT_BIT, *fragment, specialization));
  }
  const FixedState state(description, device.features.wideLines);
  const VkGraphicsPipelineCreateInfo info = create_info(state, stages, object.layout);
  return checked(
      device.vk.vkCreateGraphicsPipelines(device.device, VK_NULL_HANDLE, 1, &info, nullptr, &object.pipeline),
      "vkCreateGraphicsPipelines");
}

ContentKey key_of(const GraphicsDescription& description) {
  ContentKey key;
  key.add(description.vertex_spirv);
  key.add(description.fragment_spirv);
  add_interface(key, description.interface);
  key.add(std::span<const TextureFormat>(description.color_formats));
  for (const int value : {int(description.topology), int(description.blend), int(description.depth_compare),
                          int(description.depth_test), int(description.depth_write), int(description.depth_target),
                          int(description.cull_back_faces), int(description.cull_front_faces), description.samples})
    key.add(value);
  key.add(description.line_width);
  return key;
}

Result<std::shared_ptr<PipelineObject>> make_pipeline(Device::Impl& device, const GraphicsDescription& description) {
  CUTICLE_ASSIGN(auto object, make_layout(device, description.interface, k_stages));
  CUTICLE_TRY(create_pipeline(*object, description));
  return object;
}

}  // namespace

GraphicsPipeline::GraphicsPipeline() = default;
GraphicsPipeline::~GraphicsPipeline() = default;
GraphicsPipeline::GraphicsPipeline(GraphicsPipeline&&) noexcept = default;
GraphicsPipeline& GraphicsPipeline::operator=(GraphicsPipeline&&) noexcept = default;

Result<GraphicsPipeline> Device::make_graphics(const GraphicsDescription& description) {
  CUTICLE_TRY(check(*impl_, description));
  CUTICLE_ASSIGN(auto object,
                 shared_pipeline(*impl_, key_of(description), [&] { return make_pipeline(*impl_, description); }));
  GraphicsPipeline pipeline;
  pipeline.impl_ =
      std::make_unique<GraphicsPipeline::Impl>(GraphicsPipeline::Impl{shared_from_this(), std::move(object)});
  return pipeline;
}

}  // namespace cuticle::gpu
