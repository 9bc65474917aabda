#include <map>
#include <optional>

#include <fmt/core.h>

#include <cuticle/render/passes/lines/frame_gpu.h>
#include <cuticle/render/passes/lines/lines.h>
#include <cuticle/strands/packing/packing_gpu.h>

#include <lines_frag.spv.h>
#include <lines_vert.spv.h>

namespace cuticle::render::lines {

namespace {

class Lines : public GpuPass {
 public:
  Lines(std::shared_ptr<gpu::Device> device, gpu::Buffer frame_buffer)
      : device_(std::move(device)), frame_buffer_(std::move(frame_buffer)) {}

  /// The pipeline that draws lines of this width; made at its first use.
  Result<const gpu::GraphicsPipeline*> pipeline_of(const FrameResources& resources, float width) {
    if (const auto made = pipelines_.find(width); made != pipelines_.end()) return &made->second;
    gpu::GraphicsDescription description = target_description(resources);
    description.vertex_spirv = lines_vert;
    description.fragment_spirv = lines_frag;
    description.interface.storage_buffers = 4;
    description.interface.textures = 3;
    description.topology = gpu::Topology::lines;
    description.line_width = width;
    CUTICLE_ASSIGN(gpu::GraphicsPipeline pipeline, device_->make_graphics(description));
    return &pipelines_.emplace(width, std::move(pipeline)).first->second;
  }

  /// Before the first frame, and wherever the tables' parameters have changed since (lut::LiveTables).
  Result<void> take_tables(const FrameResources& resources) {
    CUTICLE_ASSIGN(frame_, constant_part(resources, parameters_of(resources, entry())));
    if (resources.table_set) values_ = resources.table_set->values;
    return {};
  }

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    if (resources.table_set && resources.table_set->values != values_) CUTICLE_TRY(take_tables(resources));
    set_view(frame_, resources);
    const registry::ParameterValues parameters = parameters_of(resources, entry());
    const DrawnPart part = drawn_part(resources, parameters);
    frame_.drawn_segments = part.segments;
    const DrawnBuffers buffers = packed_or_full(commands, resources);
    frame_.packed_vertices = buffers.packed ? 1 : 0;
    CUTICLE_TRY(device_->upload(frame_buffer_, gpu::bytes_of(frame_)));
    gather_transmittance(commands, resources);
    CUTICLE_ASSIGN(const gpu::GraphicsPipeline* pipeline, pipeline_of(resources, widened(line_width_, part.width)));
    begin_target(commands, resources);
    commands.draw(*pipeline, {buffers.vertices, buffers.second, &transmittance_, &frame_buffer_},
                  {table(resources, 0), table(resources, 1), table(resources, 2)}, {},
                  2 * part.strands * part.segments);
    commands.end_rendering();
    return {};
  }

  Result<void> make_parts(const FrameResources& resources) {
    const std::size_t lights = std::max<std::size_t>(1, resources.lights.size());
    CUTICLE_ASSIGN(transmittance_, device_->make_buffer(lights * resources.strands.vertex_count * sizeof(float)));
    CUTICLE_ASSIGN(no_table_, device_->make_texture({}));
    line_width_ = line_width(resources, parameters_of(resources, entry()));
    CUTICLE_TRY(pipeline_of(resources, line_width_));
    if (!parameters_of(resources, entry()).boolean("packed")) return {};
    const std::uint32_t size = resources.vertices_per_strand;
    CUTICLE_ASSIGN(packing_, strands::GpuPacking::create(*device_, resources.strands.vertex_count / size, size));
    return {};
  }

 private:
  /// What the vertex shader reads: vertices with tangents, or packed vertices with their strands' units.
  struct DrawnBuffers {
    const gpu::Buffer *vertices, *second;
    bool packed;
  };
  DrawnBuffers packed_or_full(gpu::Commands& commands, const FrameResources& resources) {
    if (!packing_) return {resources.strands.vertices, resources.tangents, false};
    packing_->record(commands, *resources.strands.vertices, *resources.tangents);
    return {&packing_->vertices(), &packing_->strands(), true};
  }

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
  float line_width_ = 1;                              ///< of all strands
  std::map<float, gpu::GraphicsPipeline> pipelines_;  ///< by the width of their lines: few, see drawn_part
  gpu::Buffer frame_buffer_, transmittance_;
  std::optional<strands::GpuPacking> packing_;  ///< where the scene asks for it
  gpu::Texture no_table_;                       ///< bound where the scene has no light, so that nothing is looked up
  registry::ParameterValues values_;            ///< of the tables that frame_ was made for
  Frame frame_{};
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  CUTICLE_ASSIGN(gpu::Buffer frame_buffer, device->make_buffer(sizeof(Frame)));
  auto pass = std::make_unique<Lines>(device, std::move(frame_buffer));
  CUTICLE_TRY(pass->take_tables(resources));
  CUTICLE_TRY(pass->make_parts(resources));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"lines", create};
  return table;
}

}  // namespace cuticle::render::lines
