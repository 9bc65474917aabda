#include "render/passes/motion_blur/motion_blur.h"
#include "render/passes/velocity/velocity_gpu.h"
#include "render/tiled_filter_gpu.h"

#include <motion_blur_comp.spv.h>
#include <motion_blur_reach_comp.spv.h>
#include <motion_blur_spread_comp.spv.h>

namespace cuticle::render::motion_blur {

namespace {

/// As shutter.glsl reads it.
struct Push {
  glm::uvec2 resolution, tiles;
  float half_shutter, largest;
  std::uint32_t samples;
};

Push push_of(const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  const auto parameters = parameters_of<Parameters>(resources);
  const glm::uvec2 resolution(view.camera.resolution);
  return {resolution, filter_tiles(view.camera.resolution), float(parameters.shutter / 2), float(parameters.largest),
          parameters.samples};
}

class MotionBlur : public GpuPass {
 public:
  explicit MotionBlur(TiledFilter filter) : filter_(std::move(filter)) {}

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const gpu::Buffer* const own = resources.get<velocity::MotionVectors>().values;
    filter_.record(commands, resources, *resources.get<velocity::MotionVectors>().values,
                   gpu::bytes_of(push_of(resources)), {&own, 1});
    return {};
  }

 private:
  TiledFilter filter_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const TiledFilter::Shaders shaders{.reach = motion_blur_reach_comp,
                                     .spread = motion_blur_spread_comp,
                                     .pixels = motion_blur_comp,
                                     .push_constant_bytes = sizeof(Push),
                                     .tile_bytes = sizeof(glm::vec2),
                                     .own_buffers = 1};
  CUTICLE_ASSIGN(TiledFilter filter,
                 TiledFilter::create(*device, shaders, resources.get<FrameView>().camera.resolution));
  return std::unique_ptr<GpuPass>(std::make_unique<MotionBlur>(std::move(filter)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"motion_blur", create};
  return table;
}

}  // namespace cuticle::render::motion_blur
