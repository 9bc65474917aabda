#include <glm/geometric.hpp>

#include "render/passes/depth_of_field/depth_of_field.h"
#include "render/passes/pixel_depth/pixel_depth_gpu.h"
#include "render/tiled_filter_gpu.h"

#include <depth_of_field_comp.spv.h>
#include <depth_of_field_reach_comp.spv.h>
#include <depth_of_field_spread_comp.spv.h>

namespace cuticle::render::depth_of_field {

namespace {

/// As lens.glsl reads it.
struct Push {
  glm::uvec2 resolution, tiles;
  float inverse_focus, lens_pixels, largest;
  std::uint32_t samples;
};

Push push_of(const Resources& resources) {
  const auto parameters = parameters_of<Parameters>(resources);
  const Camera& camera = resources.get<FrameView>().camera;
  const double focus = parameters.focus;
  const glm::uvec2 resolution(camera.resolution);
  return {resolution,
          filter_tiles(camera.resolution),
          float(1 / (focus > 0 ? focus : glm::distance(camera.target, camera.position))),
          float(1e-3 * parameters.lens_radius * pixels_per_slope(camera)),
          float(parameters.largest),
          parameters.samples};
}

class DepthOfField : public GpuPass {
 public:
  explicit DepthOfField(TiledFilter filter) : filter_(std::move(filter)) {}

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    filter_.record(commands, resources, *resources.get<pixel_depth::PixelDepth>().values,
                   gpu::bytes_of(push_of(resources)));
    return {};
  }

 private:
  TiledFilter filter_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const TiledFilter::Shaders shaders{.reach = depth_of_field_reach_comp,
                                     .spread = depth_of_field_spread_comp,
                                     .pixels = depth_of_field_comp,
                                     .push_constant_bytes = sizeof(Push),
                                     .tile_bytes = sizeof(float)};
  CUTICLE_ASSIGN(TiledFilter filter,
                 TiledFilter::create(*device, shaders, resources.get<FrameView>().camera.resolution));
  return std::unique_ptr<GpuPass>(std::make_unique<DepthOfField>(std::move(filter)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"depth_of_field", create};
  return table;
}

}  // namespace cuticle::render::depth_of_field
