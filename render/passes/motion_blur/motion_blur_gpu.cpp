#include <cuticle/gpu/groups.h>
#include <cuticle/render/passes/motion_blur/motion_blur.h>
#include <cuticle/render/picture_filter_gpu.h>

#include <motion_blur_comp.spv.h>
#include <motion_blur_reach_comp.spv.h>
#include <motion_blur_spread_comp.spv.h>

namespace cuticle::render::motion_blur {

namespace {

constexpr std::uint32_t k_tile = 16;

/// As shutter.glsl reads it.
struct Push {
  glm::uvec2 resolution, tiles;
  float half_shutter, largest;
  std::uint32_t samples;
};

Push push_of(const FrameResources& resources) {
  const registry::ParameterValues values = parameters_of(resources, entry());
  const glm::uvec2 resolution(resources.camera.resolution);
  return {resolution, (resolution + k_tile - 1u) / k_tile, float(values.real("shutter") / 2),
          float(values.integer("largest")), std::uint32_t(values.integer("samples"))};
}

class MotionBlur : public GpuPass {
 public:
  MotionBlur(gpu::Kernel reach, gpu::Kernel spread, PictureFilter filter)
      : reach_kernel_(std::move(reach)), spread_kernel_(std::move(spread)), filter_(std::move(filter)) {}

  Result<void> make_tiles(gpu::Device& device, glm::uvec2 tiles) {
    const std::size_t bytes = std::size_t(tiles.x) * tiles.y * sizeof(glm::vec2);
    CUTICLE_ASSIGN(reach_, device.make_buffer(bytes));
    CUTICLE_ASSIGN(spread_, device.make_buffer(bytes));
    return {};
  }

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    const Push push = push_of(resources);
    const gpu::Groups groups = gpu::groups_for(std::size_t(push.tiles.x) * push.tiles.y);
    commands.dispatch(reach_kernel_, {resources.motion_vectors, &reach_}, {}, gpu::bytes_of(push), groups.x, groups.y);
    commands.dispatch(spread_kernel_, {&reach_, &spread_}, {}, gpu::bytes_of(push), groups.x, groups.y);
    const gpu::Buffer* const own[] = {resources.motion_vectors, &spread_};
    filter_.record(commands, resources, gpu::bytes_of(push), own);
    return {};
  }

 private:
  gpu::Kernel reach_kernel_, spread_kernel_;
  PictureFilter filter_;
  gpu::Buffer reach_, spread_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  const gpu::ShaderInterface interface { 2, 0, sizeof(Push) };
  CUTICLE_ASSIGN(gpu::Kernel reach, device->make_kernel(motion_blur_reach_comp, interface));
  CUTICLE_ASSIGN(gpu::Kernel spread, device->make_kernel(motion_blur_spread_comp, interface));
  CUTICLE_ASSIGN(PictureFilter filter,
                 PictureFilter::create(*device, motion_blur_comp, resources.camera.resolution, sizeof(Push), 2));
  auto pass = std::make_unique<MotionBlur>(std::move(reach), std::move(spread), std::move(filter));
  CUTICLE_TRY(pass->make_tiles(*device, push_of(resources).tiles));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"motion_blur", create};
  return table;
}

}  // namespace cuticle::render::motion_blur
