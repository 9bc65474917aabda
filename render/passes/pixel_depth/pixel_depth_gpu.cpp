#include "gpu/groups.h"
#include "render/pass_gpu.h"
#include "render/passes/aovs/aovs.h"

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

class PixelDepth : public GpuPass {
 public:
  PixelDepth(gpu::Kernel kernel, gpu::Buffer depths) : kernel_(std::move(kernel)), depths_(std::move(depths)) {}

  void publish(FrameResources& resources) const override { resources.pixel_depth = &depths_; }

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    const Camera& camera = resources.camera;
    const Push push{glm::uvec2(camera.resolution), float(1 / camera.near_plane), float(1 / camera.far_plane),
                    std::uint32_t(resources.supersampling),
                    resources.aovs ? std::uint32_t(std::size(aovs::k_channels)) : 0u};
    const gpu::Groups groups = gpu::groups_for(std::size_t(push.resolution.x) * push.resolution.y);
    commands.dispatch(kernel_, {resources.aovs ? resources.aovs : &depths_, &depths_}, {resources.depth},
                      gpu::bytes_of(push), groups.x, groups.y);
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

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  const std::size_t pixels = std::size_t(resources.camera.resolution.x) * std::size_t(resources.camera.resolution.y);
  CUTICLE_ASSIGN(gpu::Kernel kernel, make_kernel(*device, resources.depth->samples()));
  CUTICLE_ASSIGN(gpu::Buffer depths, device->make_buffer(pixels * sizeof(float)));
  return std::unique_ptr<GpuPass>(std::make_unique<PixelDepth>(std::move(kernel), std::move(depths)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"pixel_depth", create};
  return table;
}

}  // namespace cuticle::render::pixel_depth
