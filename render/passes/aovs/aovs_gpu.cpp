#include "render/passes/aovs/aovs_gpu.h"

#include "gpu/groups.h"
#include "render/pass_gpu.h"
#include "render/strand_shading/frame_gpu.h"
#include "render/visibility/drawn_part_gpu.h"
#include "strands/spline/drawn_gpu.h"

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

  std::optional<FileLayer> layer(std::string_view wanted, const Resources&) const override {
    if (wanted == name_of<Layers>()) return FileLayer{&values_, k_channels};
    if (wanted == name_of<SeenVelocities>() && velocities_) return FileLayer{&velocities_, k_velocity_channels};
    return std::nullopt;
  }

  void publish(Resources& resources) const override {
    resources.put(Layers{&values_, velocities_ ? &velocities_ : nullptr});
  }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const Camera& camera = resources.get<FrameView>().camera;
    const bool shadowed = !transmittance_of(resources).reached.empty();
    const Push push{glm::mat4(projection_matrix(camera) * view_matrix(camera)),
                    glm::uvec2(camera.resolution),
                    resources.get<DrawnHair>().vertices_per_strand,
                    drawn_segments(resources),
                    shadowed ? 1u : 0u,
                    velocities_ ? 1u : 0u};
    const gpu::Groups groups = gpu::groups_for(std::size_t(push.resolution.x) * push.resolution.y);
    std::vector<const gpu::Buffer*> buffers = read_buffers(resources);
    std::vector<const gpu::Texture*> textures;
    const SeenHair& seen = resources.get<SeenHair>();
    if (seen.samples)
      textures.push_back(seen.samples);
    else
      buffers.push_back(seen.pixels);
    commands.dispatch(kernel_, buffers, textures, gpu::bytes_of(push), groups.x, groups.y);
    return {};
  }

 private:
  /// Of each strand, by the pass that drew into a visibility buffer.
  static std::uint32_t drawn_segments(const Resources& resources) {
    const StrandDraw& draw = resources.get<StrandDraw>();
    if (draw.corners == 0) return resources.get<DrawnHair>().vertices_per_strand - 1;
    return visibility::drawn_part(resources, draw.full_px, draw.whole_segments).segments;
  }

  /// Bindings 0 .. 7 of aovs.glsl; what is not there has another in its place.
  std::vector<const gpu::Buffer*> read_buffers(const Resources& resources) const {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const gpu::Buffer* const tangents = hair.tangents;
    const auto reached = [&](std::size_t k) {
      const bool is_there =
          k < transmittance_of(resources).channels.count && !transmittance_of(resources).reached.empty();
      return is_there ? transmittance_of(resources).reached[k] : &values_;
    };
    return {hair.strands.vertices,
            tangents,
            reached(0),
            &values_,
            velocities_ ? resources.get<DrawnVelocities>().values : tangents,
            velocities_ ? &velocities_ : &values_,
            reached(1),
            reached(2)};
  }

  gpu::Kernel kernel_;
  gpu::Buffer values_;
  gpu::Buffer velocities_;  ///< empty where nothing asks
};

/// By what the strands' pass leaves: samples of a visibility buffer, or what each pixel sees.
Result<gpu::Kernel> make_kernel(gpu::Device& device, const Resources& resources) {
  const gpu::Texture* const seen = resources.get<SeenHair>().samples;
  const int samples = seen ? seen->samples() : 1;
  std::vector<std::uint32_t> constants = with_channels({std::uint32_t(samples)}, transmittance_of(resources).channels);
  constants.push_back(std::uint32_t(resources.get<Targets>().supersampling));
  const std::vector<gpu::TexelBinding> texels = {strands::drawn_texels(0), strands::drawn_texels(1),
                                                 strands::drawn_texels(4)};
  if (!seen) return device.make_kernel(aovs_comp, {9, 0, sizeof(Push), constants, texels});
  const gpu::ShaderInterface interface { 8, 1, sizeof(Push), constants, texels };
  return samples > 1 ? device.make_kernel(aovs_many_comp, interface) : device.make_kernel(aovs_one_comp, interface);
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  const std::size_t pixels = std::size_t(view.camera.resolution.x) * std::size_t(view.camera.resolution.y);
  CUTICLE_ASSIGN(gpu::Kernel kernel, make_kernel(*device, resources));
  CUTICLE_ASSIGN(gpu::Buffer values, device->make_buffer(pixels * std::size(k_channels) * sizeof(float)));
  gpu::Buffer velocities;
  if (resources.find<DrawnVelocities>()) {
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
