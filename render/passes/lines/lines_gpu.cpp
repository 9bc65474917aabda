#include <fmt/core.h>

#include <cuticle/render/passes/lines/frame_gpu.h>
#include <cuticle/render/passes/lines/lines.h>

#include <lines_frag.spv.h>
#include <lines_vert.spv.h>

namespace cuticle::render::lines {

namespace {

class Lines : public GpuPass {
 public:
  Lines(std::shared_ptr<gpu::Device> device, gpu::GraphicsPipeline pipeline, gpu::Buffer frame_buffer)
      : device_(std::move(device)), pipeline_(std::move(pipeline)), frame_buffer_(std::move(frame_buffer)) {}

  /// Before the first frame, and wherever the tables' parameters have changed since (lut::LiveTables).
  Result<void> take_tables(const FrameResources& resources) {
    CUTICLE_ASSIGN(frame_, constant_part(resources, parameters_of(resources, entry())));
    if (resources.table_set) values_ = resources.table_set->values;
    return {};
  }

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    if (resources.table_set && resources.table_set->values != values_) CUTICLE_TRY(take_tables(resources));
    set_view(frame_, resources);
    CUTICLE_TRY(device_->upload(frame_buffer_, gpu::bytes_of(frame_)));
    gather_transmittance(commands, resources);
    begin_target(commands, resources);
    commands.draw(
        pipeline_,
        {resources.strands.vertices, resources.tangents, resources.strands.segments, &transmittance_, &frame_buffer_},
        {table(resources, 0), table(resources, 1), table(resources, 2)}, {}, 2 * resources.strands.segment_count);
    commands.end_rendering();
    return {};
  }

  Result<void> make_buffers(const FrameResources& resources) {
    const std::size_t lights = std::max<std::size_t>(1, resources.lights.size());
    CUTICLE_ASSIGN(transmittance_, device_->make_buffer(lights * resources.strands.vertex_count * sizeof(float)));
    CUTICLE_ASSIGN(no_table_, device_->make_texture({}));
    return {};
  }

 private:
  /// One buffer for all lights; 1 everywhere where nothing shadows.
  void gather_transmittance(gpu::Commands& commands, const FrameResources& resources) {
    const std::size_t bytes = resources.strands.vertex_count * sizeof(float);
    constexpr std::uint32_t k_one = 0x3F800000;  // 1.0f
    if (resources.transmittance.empty()) commands.fill(transmittance_, k_one);
    for (std::size_t k = 0; k < resources.transmittance.size(); ++k)
      commands.copy(*resources.transmittance[k], transmittance_, bytes, 0, k * bytes);
  }

  const gpu::Texture* table(const FrameResources& resources, std::size_t index) const {
    return index < resources.tables.size() ? resources.tables[index] : &no_table_;
  }

  std::shared_ptr<gpu::Device> device_;
  gpu::GraphicsPipeline pipeline_;
  gpu::Buffer frame_buffer_, transmittance_;
  gpu::Texture no_table_;             ///< bound where the scene has no light, so that nothing is looked up
  registry::ParameterValues values_;  ///< of the tables that frame_ was made for
  Frame frame_{};
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  const registry::ParameterValues parameters = parameters_of(resources, entry());
  gpu::GraphicsDescription description = target_description(resources);
  description.vertex_spirv = lines_vert;
  description.fragment_spirv = lines_frag;
  description.interface.storage_buffers = 5;
  description.interface.textures = 3;
  description.topology = gpu::Topology::lines;
  description.line_width = line_width(resources, parameters);
  CUTICLE_ASSIGN(gpu::GraphicsPipeline pipeline, device->make_graphics(description));
  CUTICLE_ASSIGN(gpu::Buffer frame_buffer, device->make_buffer(sizeof(Frame)));
  auto pass = std::make_unique<Lines>(device, std::move(pipeline), std::move(frame_buffer));
  CUTICLE_TRY(pass->take_tables(resources));
  CUTICLE_TRY(pass->make_buffers(resources));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"lines", create};
  return table;
}

}  // namespace cuticle::render::lines
