#include "render/passes/ambient_occlusion/ambient_occlusion.h"
#include "render/picture_filter_gpu.h"

#include <ambient_occlusion_comp.spv.h>

namespace cuticle::render::ambient_occlusion {

namespace {

/// As ambient_occlusion.comp reads it.
struct Push {
  glm::uvec2 resolution;
  float radius, pixels_per_slope, largest, strength;
  std::uint32_t samples;
};

class AmbientOcclusion : public GpuPass {
 public:
  explicit AmbientOcclusion(PictureFilter filter) : filter_(std::move(filter)) {}

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const FrameView& view = resources.get<FrameView>();
    const auto parameters = parameters_of<Parameters>(resources);
    const Push push{glm::uvec2(view.camera.resolution),   float(1e-3 * parameters.radius),
                    float(pixels_per_slope(view.camera)), float(parameters.largest),
                    float(parameters.strength),           parameters.samples};
    filter_.record(commands, resources, gpu::bytes_of(push));
    return {};
  }

 private:
  PictureFilter filter_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_ASSIGN(PictureFilter filter,
                 PictureFilter::create(*device, ambient_occlusion_comp, resources.get<FrameView>().camera.resolution,
                                       sizeof(Push)));
  return std::unique_ptr<GpuPass>(std::make_unique<AmbientOcclusion>(std::move(filter)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"ambient_occlusion", create};
  return table;
}

}  // namespace cuticle::render::ambient_occlusion
