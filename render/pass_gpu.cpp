#include "render/pass_gpu.h"

namespace cuticle::render {

glm::ivec2 drawn_size(const FrameResources& resources) {
  return resources.part_size == glm::ivec2(0) ? resources.camera.resolution : resources.part_size;
}

glm::dmat4 drawn_world_to_clip(const FrameResources& resources) {
  const glm::dmat4 whole = projection_matrix(resources.camera) * view_matrix(resources.camera);
  if (resources.part_size == glm::ivec2(0)) return whole;
  const glm::dvec2 all(resources.camera.resolution), part(resources.part_size), corner(resources.part_corner);
  const glm::dvec2 scale = all / part, shift = (all - 2.0 * corner) / part - 1.0;
  glm::dmat4 cut(1);
  for (int axis = 0; axis < 2; ++axis) {
    cut[axis][axis] = scale[axis];
    cut[3][axis] = shift[axis];
  }
  return cut * whole;
}

gpu::GraphicsDescription target_description(const FrameResources& resources) {
  gpu::GraphicsDescription description;
  description.color_formats = {resources.color->format()};
  description.depth_test = description.depth_write = true;
  description.samples = resources.color->samples();
  return description;
}

gpu::Commands::Target color_target(const FrameResources& resources) {
  const bool resolves = resources.resolve_target && resources.color != resources.resolved;
  return {.color = resources.color, .resolve = resolves ? resources.resolved : nullptr, .keep = resources.keep_target};
}

Result<gpu::Texture> make_visibility(gpu::Device& device, const gpu::Texture& target) {
  return device.make_texture({.size = target.size(),
                              .format = gpu::TextureFormat::r32u,
                              .filter = gpu::Filter::nearest,
                              .samples = target.samples(),
                              .render_target = true,
                              .read_samples = target.samples() > 1});
}

Result<gpu::Buffer> make_seen(gpu::Device& device, const FrameResources& resources) {
  const glm::ivec2 size = resources.says_seen ? resources.camera.resolution : glm::ivec2(1);
  return device.make_buffer(std::size_t(size.x) * std::size_t(size.y) * sizeof(Seen));
}

std::vector<std::uint32_t> with_channels(std::vector<std::uint32_t> before, const shadows::Channels& channels) {
  before.push_back(channels.count);
  before.insert(before.end(), channels.of.begin(), channels.of.end());
  return before;
}

void begin_target(gpu::Commands& commands, const FrameResources& resources) {
  const gpu::Commands::Target target = color_target(resources);
  commands.begin_rendering({&target, 1}, resources.depth, resources.keep_target);
}

}  // namespace cuticle::render
