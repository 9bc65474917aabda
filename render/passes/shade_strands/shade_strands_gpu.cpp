#include <cuticle/gpu/groups.h>
#include <cuticle/render/passes/lines/shading_inputs_gpu.h>
#include <cuticle/render/passes/tile_lists/tile_lists_gpu.h>

#include <shade_strands_comp.spv.h>

namespace cuticle::render::shade_strands {

namespace {

class ShadeStrands : public GpuPass {
 public:
  ShadeStrands(gpu::Kernel kernel, lines::ShadingInputs inputs, gpu::Buffer colors)
      : kernel_(std::move(kernel)), inputs_(std::move(inputs)), colors_(std::move(colors)) {}

  void publish(FrameResources& resources) const override { resources.strand_colors = &colors_; }

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    CUTICLE_TRY(inputs_.update(resources));
    CUTICLE_TRY(inputs_.record(commands, resources));
    const std::uint32_t only_visible = resources.tile_lists ? 1 : 0;
    const gpu::Buffer& visible = resources.tile_lists ? resources.tile_lists->visible : inputs_.frame();
    const gpu::Groups groups = gpu::groups_for(resources.strands.vertex_count);
    commands.dispatch(kernel_,
                      {resources.strands.vertices, resources.tangents, &colors_, &inputs_.frame(),
                       &inputs_.transmittance(), &visible},
                      {inputs_.table(resources, 0), inputs_.table(resources, 1), inputs_.table(resources, 2)},
                      gpu::bytes_of(only_visible), groups.x, groups.y);
    return {};
  }

 private:
  gpu::Kernel kernel_;
  lines::ShadingInputs inputs_;
  gpu::Buffer colors_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  CUTICLE_ASSIGN(
      gpu::Kernel kernel,
      device->make_kernel(shade_strands_comp, {.storage_buffers = 6, .textures = 3, .push_constant_bytes = 4}));
  CUTICLE_ASSIGN(gpu::Buffer colors, device->make_buffer(resources.strands.vertex_count * sizeof(glm::uvec2)));
  CUTICLE_ASSIGN(lines::ShadingInputs inputs, lines::ShadingInputs::make(std::move(device), resources));
  return std::unique_ptr<GpuPass>(
      std::make_unique<ShadeStrands>(std::move(kernel), std::move(inputs), std::move(colors)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"shade_strands", create};
  return table;
}

}  // namespace cuticle::render::shade_strands
