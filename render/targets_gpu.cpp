#include "render/targets_gpu.h"

namespace cuticle::render {

glm::ivec2 drawn_size(const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  return view.part_size == glm::ivec2(0) ? view.camera.resolution : view.part_size;
}

glm::dmat4 drawn_world_to_clip(const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  const glm::dmat4 whole = projection_matrix(view.camera) * view_matrix(view.camera);
  if (view.part_size == glm::ivec2(0)) return whole;
  const glm::dvec2 all(view.camera.resolution), part(view.part_size), corner(view.part_corner);
  const glm::dvec2 scale = all / part, shift = (all - 2.0 * corner) / part - 1.0;
  glm::dmat4 cut(1);
  for (int axis = 0; axis < 2; ++axis) {
    cut[axis][axis] = scale[axis];
    cut[3][axis] = shift[axis];
  }
  return cut * whole;
}

gpu::GraphicsDescription target_description(const Resources& resources) {
  const Targets& targets = resources.get<Targets>();
  gpu::GraphicsDescription description;
  description.color_formats = {targets.color->format()};
  description.depth_test = description.depth_write = true;
  description.samples = targets.color->samples();
  return description;
}

gpu::Commands::Target color_target(const Resources& resources) {
  const Targets& targets = resources.get<Targets>();
  const bool resolves = targets.resolves && targets.color != targets.resolved;
  return {.color = targets.color, .resolve = resolves ? targets.resolved : nullptr, .keep = targets.keep};
}

Result<gpu::Texture> make_visibility(gpu::Device& device, const gpu::Texture& target) {
  return device.make_texture({.size = target.size(),
                              .format = gpu::TextureFormat::r32u,
                              .filter = gpu::Filter::nearest,
                              .samples = target.samples(),
                              .render_target = true,
                              .read_samples = target.samples() > 1});
}

Result<gpu::Buffer> make_seen(gpu::Device& device, const Resources& resources) {
  const glm::ivec2 size = resources.wants<SeenHair>() ? resources.get<FrameView>().camera.resolution : glm::ivec2(1);
  return device.make_buffer(std::size_t(size.x) * std::size_t(size.y) * sizeof(Seen));
}

std::vector<std::uint32_t> with_channels(std::vector<std::uint32_t> before, const shadows::Channels& channels) {
  before.push_back(channels.count);
  before.insert(before.end(), channels.of.begin(), channels.of.end());
  return before;
}

void begin_target(gpu::Commands& commands, const Resources& resources) {
  const Targets& targets = resources.get<Targets>();
  const gpu::Commands::Target target = color_target(resources);
  commands.begin_rendering({&target, 1}, targets.depth, targets.keep);
}

}  // namespace cuticle::render
