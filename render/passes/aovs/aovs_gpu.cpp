#include "gpu/groups.h"
#include "render/pass_gpu.h"
#include "render/passes/aovs/aovs.h"
#include "render/passes/lines/frame_gpu.h"

#include <aovs_comp.spv.h>
#include <aovs_many_comp.spv.h>
#include <aovs_one_comp.spv.h>

namespace cuticle::render::aovs {

namespace {

/// As aovs.comp reads it.
struct Push {
  glm::mat4 world_to_clip;
  glm::uvec2 resolution;
  std::uint32_t vertices_per_strand, drawn_segments, shadowed, moves;
};

class Aovs : public GpuPass {
 public:
  Aovs(gpu::Kernel kernel, gpu::Buffer values, gpu::Buffer velocities)
      : kernel_(std::move(kernel)), values_(std::move(values)), velocities_(std::move(velocities)) {}

  void publish(FrameResources& resources) const override {
    resources.aovs = &values_;
    if (velocities_) resources.seen_velocities = &velocities_;
  }

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    const Camera& camera = resources.camera;
    const bool shadowed = !resources.transmittance.empty();
    const Push push{glm::mat4(projection_matrix(camera) * view_matrix(camera)),
                    glm::uvec2(camera.resolution),
                    resources.vertices_per_strand,
                    drawn_segments(resources),
                    shadowed ? 1u : 0u,
                    velocities_ ? 1u : 0u};
    const gpu::Groups groups = gpu::groups_for(std::size_t(push.resolution.x) * push.resolution.y);
    std::vector<const gpu::Buffer*> buffers = read_buffers(resources);
    std::vector<const gpu::Texture*> textures;
    if (resources.seen_samples)
      textures.push_back(resources.seen_samples);
    else
      buffers.push_back(resources.seen);
    commands.dispatch(kernel_, buffers, textures, gpu::bytes_of(push), groups.x, groups.y);
    return {};
  }

 private:
  /// Of each strand, by the pass that drew into a visibility buffer.
  static std::uint32_t drawn_segments(const FrameResources& resources) {
    if (!resources.strand_draw) return resources.vertices_per_strand - 1;
    return lines::drawn_part(resources, resources.strand_draw->full_px(resources.parameters)).segments;
  }

  /// Bindings 0 .. 7 of aovs.glsl; what is not there has another in its place.
  std::vector<const gpu::Buffer*> read_buffers(const FrameResources& resources) const {
    const gpu::Buffer* const tangents = resources.tangents;
    const auto reached = [&](std::size_t k) {
      const bool is_there = k < resources.channels.count && !resources.transmittance.empty();
      return is_there ? resources.transmittance[k] : tangents;
    };
    return {resources.strands.vertices,
            tangents,
            reached(0),
            &values_,
            velocities_ ? resources.velocities : tangents,
            velocities_ ? &velocities_ : &values_,
            reached(1),
            reached(2)};
  }

  gpu::Kernel kernel_;
  gpu::Buffer values_;
  gpu::Buffer velocities_;  ///< empty where nothing asks
};

/// By what the strands' pass leaves: samples of a visibility buffer, or what each pixel sees.
Result<gpu::Kernel> make_kernel(gpu::Device& device, const FrameResources& resources) {
  const int samples = resources.seen_samples ? resources.seen_samples->samples() : 1;
  std::vector<std::uint32_t> constants = with_channels({std::uint32_t(samples)}, resources.channels);
  constants.push_back(std::uint32_t(resources.supersampling));
  if (!resources.seen_samples) return device.make_kernel(aovs_comp, {9, 0, sizeof(Push), constants});
  const gpu::ShaderInterface interface { 8, 1, sizeof(Push), constants };
  return samples > 1 ? device.make_kernel(aovs_many_comp, interface) : device.make_kernel(aovs_one_comp, interface);
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  const std::size_t pixels = std::size_t(resources.camera.resolution.x) * std::size_t(resources.camera.resolution.y);
  CUTICLE_ASSIGN(gpu::Kernel kernel, make_kernel(*device, resources));
  CUTICLE_ASSIGN(gpu::Buffer values, device->make_buffer(pixels * std::size(k_channels) * sizeof(float)));
  gpu::Buffer velocities;
  if (resources.velocities) {
    CUTICLE_ASSIGN(velocities, device->make_buffer(pixels * std::size(k_velocity_channels) * sizeof(float)));
  }
  return std::unique_ptr<GpuPass>(std::make_unique<Aovs>(std::move(kernel), std::move(values), std::move(velocities)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"aovs", create};
  return table;
}

}  // namespace cuticle::render::aovs
