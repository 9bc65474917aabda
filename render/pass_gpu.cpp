#include <cuticle/render/pass_gpu.h>

namespace cuticle::render {

registry::ParameterValues parameters_of(const FrameResources& resources, const Pass& pass) {
  const auto found = resources.parameters.find(pass.entry.name);
  return found == resources.parameters.end() ? registry::default_values(pass.entry.parameters) : found->second;
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

Result<gpu::Buffer> make_seen(gpu::Device& device, const FrameResources& resources) {
  const glm::ivec2 size = resources.says_seen ? resources.camera.resolution : glm::ivec2(1);
  return device.make_buffer(std::size_t(size.x) * std::size_t(size.y) * sizeof(Seen));
}

void begin_target(gpu::Commands& commands, const FrameResources& resources) {
  const gpu::Commands::Target target = color_target(resources);
  commands.begin_rendering({&target, 1}, resources.depth, resources.keep_target);
}

}  // namespace cuticle::render
