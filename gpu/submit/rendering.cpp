#include <fmt/format.h>

#include "gpu/detail/commands_impl.h"

namespace cuticle::gpu {
namespace {

VkRenderingAttachmentInfo attachment(const TextureObject& texture, bool keep) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = texture.view;
  info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  info.loadOp = keep ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

// The attachments of one rendering, all of one size.
struct Attachments {
  std::vector<VkRenderingAttachmentInfo> color;
  VkRenderingAttachmentInfo depth{};
  glm::ivec2 size{0};
};

// A render target of this device and of the size of the others; null (and an error kept) if it is not.
std::shared_ptr<TextureObject> target_of(Commands::Impl& commands, const Texture* texture, Attachments& attachments) {
  auto object = object_of(commands, texture);
  if (!object) return nullptr;
  const TextureDescription& description = object->description;
  if (attachments.size == glm::ivec2(0)) attachments.size = description.size;
  if (description.render_target && description.size == attachments.size) return object;
  fail(commands, internal_error(fmt::format(
                     "gpu: rendering to a texture of {} x {} that is {}", description.size.x, description.size.y,
                     description.render_target ? "of another size than the first" : "no render target")));
  return nullptr;
}

bool add_resolve(Commands::Impl& commands, const Texture* resolve, Attachments& attachments) {
  if (!resolve) return true;
  const auto object = target_of(commands, resolve, attachments);
  if (!object) return false;
  VkRenderingAttachmentInfo& info = attachments.color.back();
  info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
  info.resolveImageView = object->view;
  info.resolveImageLayout = VK_IMAGE_LAYOUT_GENERAL;
  return true;
}

bool add_color(Commands::Impl& commands, const Commands::Target& target, Attachments& attachments) {
  const auto object = target_of(commands, target.color, attachments);
  if (!object) return false;
  attachments.color.push_back(attachment(*object, target.keep));
  attachments.color.back().clearValue.color = {{target.clear.r, target.clear.g, target.clear.b, target.clear.a}};
  return add_resolve(commands, object->description.samples > 1 ? target.resolve : nullptr, attachments);
}

bool add_depth(Commands::Impl& commands, const Texture* depth, bool keep, Attachments& attachments) {
  if (!depth) return true;
  const auto object = target_of(commands, depth, attachments);
  if (!object) return false;
  attachments.depth = attachment(*object, keep);
  attachments.depth.clearValue.depthStencil = {1.0f, 0};
  return true;
}

void start(Commands::Impl& commands, const Attachments& attachments, bool with_depth) {
  Device::Impl& device = *commands.device->impl();
  const VkRect2D area{{0, 0}, {std::uint32_t(attachments.size.x), std::uint32_t(attachments.size.y)}};
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea = area;
  info.layerCount = 1;
  info.colorAttachmentCount = std::uint32_t(attachments.color.size());
  info.pColorAttachments = attachments.color.data();
  info.pDepthAttachment = with_depth ? &attachments.depth : nullptr;
  full_barrier(device, commands.buffer);
  device.vk.vkCmdBeginRendering(commands.buffer, &info);
  const VkViewport viewport{0, 0, float(attachments.size.x), float(attachments.size.y), 0, 1};
  device.vk.vkCmdSetViewport(commands.buffer, 0, 1, &viewport);
  device.vk.vkCmdSetScissor(commands.buffer, 0, 1, &area);
}

bool ready_to_draw(Commands::Impl& commands, const GraphicsPipeline& pipeline, const Resources& resources) {
  if (commands.error) return false;
  if (!commands.in_rendering)
    return fail(commands, internal_error("gpu: draw outside begin_rendering and end_rendering")), false;
  if (!pipeline) return fail(commands, internal_error("gpu: an empty pipeline was drawn")), false;
  return gpu::bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.impl()->object, resources);
}

}  // namespace

void Commands::begin_rendering(std::span<const Target> color, const Texture* depth, bool keep_depth) {
  if (impl_->error) return;
  if (impl_->in_rendering) return fail(*impl_, internal_error("gpu: begin_rendering inside begin_rendering"));
  Attachments attachments;
  for (const Target& target : color)
    if (!add_color(*impl_, target, attachments)) return;
  if (!add_depth(*impl_, depth, keep_depth, attachments)) return;
  if (attachments.size == glm::ivec2(0)) return fail(*impl_, internal_error("gpu: rendering without a target"));
  start(*impl_, attachments, depth != nullptr);
  impl_->in_rendering = true;
}

void Commands::draw(const GraphicsPipeline& pipeline, std::initializer_list<const Buffer*> buffers,
                    std::initializer_list<const Texture*> textures, std::span<const std::byte> push_constants,
                    std::uint32_t vertices, std::uint32_t instances) {
  const Resources resources{{buffers.begin(), buffers.size()}, {textures.begin(), textures.size()}, push_constants};
  if (!ready_to_draw(*impl_, pipeline, resources)) return;
  impl_->device->impl()->vk.vkCmdDraw(impl_->buffer, vertices, instances, 0, 0);
  if (impl_->open_passes > 0) ++impl_->passes.back().draws;
}

void Commands::draw_counted(const GraphicsPipeline& pipeline, std::initializer_list<const Buffer*> buffers,
                            std::initializer_list<const Texture*> textures, std::span<const std::byte> push_constants,
                            const Buffer& numbers) {
  const Resources resources{{buffers.begin(), buffers.size()}, {textures.begin(), textures.size()}, push_constants};
  if (!ready_to_draw(*impl_, pipeline, resources)) return;
  const auto object = object_of(*impl_, &numbers);
  if (!object) return;
  impl_->device->impl()->vk.vkCmdDrawIndirect(impl_->buffer, object->handle, 0, 1, 0);
  if (impl_->open_passes > 0) ++impl_->passes.back().draws;
}

void Commands::end_rendering() {
  if (impl_->error) return;
  if (!impl_->in_rendering) return fail(*impl_, internal_error("gpu: end_rendering without begin_rendering"));
  impl_->in_rendering = false;
  impl_->device->impl()->vk.vkCmdEndRendering(impl_->buffer);
}

}  // namespace cuticle::gpu
