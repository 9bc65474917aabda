#include "render/passes/pixel_depth/pixel_depth_gpu.h"

#include "gpu/groups.h"
#include "render/pass_gpu.h"
#include "render/passes/aovs/aovs_gpu.h"

#include <pixel_depth_many_comp.spv.h>
#include <pixel_depth_one_comp.spv.h>

namespace cuticle::render::pixel_depth {

namespace {

/// As pixel_depth.glsl reads it.
struct Push {
  glm::uvec2 resolution;
  float inverse_near, inverse_far;
  std::uint32_t supersampling, aov_count;
};

class PixelDepthPass : public GpuPass {
 public:
  PixelDepthPass(gpu::Kernel kernel, gpu::Buffer depths) : kernel_(std::move(kernel)), depths_(std::move(depths)) {}

  void publish(Resources& resources) const override { resources.put(PixelDepth{&depths_}); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const Targets& targets = resources.get<Targets>();
    const Camera& camera = resources.get<FrameView>().camera;
    const auto* const layers = resources.find<aovs::Layers>();
    const Push push{glm::uvec2(camera.resolution), float(1 / camera.near_plane), float(1 / camera.far_plane),
                    std::uint32_t(targets.supersampling), layers ? std::uint32_t(std::size(aovs::k_channels)) : 0u};
    const gpu::Groups groups = gpu::groups_for(std::size_t(push.resolution.x) * push.resolution.y);
    commands.dispatch(kernel_, {layers ? layers->values : &depths_, &depths_}, {targets.depth}, gpu::bytes_of(push),
                      groups.x, groups.y);
    return {};
  }

 private:
  gpu::Kernel kernel_;
  gpu::Buffer depths_;
};

Result<gpu::Kernel> make_kernel(gpu::Device& device, int samples) {
  gpu::ShaderInterface interface;
  interface.storage_buffers = 2;
  interface.textures = 1;
  interface.push_constant_bytes = sizeof(Push);
  if (samples == 1) return device.make_kernel(pixel_depth_one_comp, interface);
  interface.specialization = {std::uint32_t(samples)};
  return device.make_kernel(pixel_depth_many_comp, interface);
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  const std::size_t pixels = std::size_t(view.camera.resolution.x) * std::size_t(view.camera.resolution.y);
  CUTICLE_ASSIGN(gpu::Kernel kernel, make_kernel(*device, resources.get<Targets>().depth->samples()));
  CUTICLE_ASSIGN(gpu::Buffer depths, device->make_buffer(pixels * sizeof(float)));
  return std::unique_ptr<GpuPass>(std::make_unique<PixelDepthPass>(std::move(kernel), std::move(depths)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"pixel_depth", create};
  return table;
}

}  // namespace cuticle::render::pixel_depth
