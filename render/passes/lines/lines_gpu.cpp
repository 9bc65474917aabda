#include <map>
#include <optional>

#include "render/passes/bake_tables/bake_tables.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/cull_strands/cull_strands_gpu.h"
#include "render/passes/dual_scattering/dual_scattering_gpu.h"
#include "render/passes/lines/line_width_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/strand_shading/shading_inputs_gpu.h"
#include "render/visibility/drawn_part_gpu.h"
#include "strands/packing/packing_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <lines_coloured_frag.spv.h>
#include <lines_coloured_seen_frag.spv.h>
#include <lines_coloured_vert.spv.h>
#include <lines_frag.spv.h>
#include <lines_seen_frag.spv.h>
#include <lines_vert.spv.h>

namespace cuticle::render::lines {

namespace {

std::span<const std::uint32_t> fragment_shader(bool coloured, bool says_seen) {
  if (coloured) return says_seen ? std::span<const std::uint32_t>(lines_coloured_seen_frag) : lines_coloured_frag;
  return says_seen ? std::span<const std::uint32_t>(lines_seen_frag) : lines_frag;
}

void set_shaders(gpu::GraphicsDescription& description, const Resources& resources) {
  const bool coloured = transmittance_of(resources).channels.count > 1;
  description.vertex_spirv = lines_vert;
  if (coloured) description.vertex_spirv = lines_coloured_vert;
  description.fragment_spirv = fragment_shader(coloured, resources.wants<SeenHair>());
  std::vector<std::uint32_t> constants =
      dual_scattering::with_dual_scattering(with_channels({}, transmittance_of(resources).channels), resources);
  constants.push_back(parameters_of<bake_tables::Parameters>(resources).mip_levels ? 1 : 0);
  constants.push_back(cull_strands::is_listed(resources));
  constants.push_back(std::uint32_t(resources.get<Targets>().color->samples()));
  constants.push_back(resources.get<FibreMaterial>().evaluates_directly ? 1 : 0);
  description.interface = {10,
                           3,
                           0,
                           strand_shading::with_layout(std::move(constants), bake_tables::table_set_of(resources)),
                           {strands::drawn_texels(0), strands::drawn_texels(1), GatheredTransmittance::texels(2)}};
}

class Lines : public GpuPass {
 public:
  Lines(std::shared_ptr<gpu::Device> device, strand_shading::ShadingInputs inputs)
      : device_(std::move(device)), inputs_(std::move(inputs)) {}

  void publish(Resources& resources) const override {
    if (seen_) resources.put(SeenHair{.samples = &seen_});
  }

  Result<bool> take_parameters(const Resources& resources) override { return inputs_.take_parameters(resources); }

  /// The pipeline that draws lines of this width; made at its first use.
  Result<const gpu::GraphicsPipeline*> pipeline_of(const Resources& resources, float width) {
    if (const auto made = pipelines_.find(width); made != pipelines_.end()) return &made->second;
    gpu::GraphicsDescription description = target_description(resources);
    set_shaders(description, resources);
    if (seen_) description.color_formats.push_back(seen_.format());
    description.topology = gpu::Topology::lines;
    description.line_width = width;
    CUTICLE_ASSIGN(gpu::GraphicsPipeline pipeline, device_->make_graphics(description));
    return &pipelines_.emplace(width, std::move(pipeline)).first->second;
  }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    strand_shading::Frame& frame = inputs_.update(resources);
    const visibility::DrawnPart part =
        visibility::drawn_part(resources, parameters_of<Parameters>(resources).full_px, true);
    frame.drawn_segments = part.segments;
    const float width = widened(line_width(resources), part.width);
    frame.opacity_of_radius = opacity_of_radius(resources, part, width);
    CUTICLE_ASSIGN(const gpu::GraphicsPipeline* pipeline, pipeline_of(resources, width));
    frame.packed_vertices = packing_ ? 1 : 0;
    CUTICLE_TRY(inputs_.record(commands, resources));
    const DrawnHair& hair = resources.get<DrawnHair>();
    if (packing_) packing_->record(commands, *hair.strands.vertices, *hair.tangents);
    begin(commands, resources);
    const dual_scattering::Inputs dual = dual_scattering::inputs_of(resources, inputs_.frame());
    cull_strands::draw(
        commands, resources, *pipeline,
        {hair.strands.vertices, hair.tangents, &inputs_.transmittance(), &inputs_.frame(), dual.terms, dual.visibility,
         &cull_strands::list_of(resources, inputs_.frame()), &inputs_.scattered(),
         packing_ ? &packing_->vertices() : &inputs_.frame(), packing_ ? &packing_->strands() : &inputs_.frame()},
        {inputs_.table(resources, 0), inputs_.table(resources, 1), inputs_.table(resources, 2)}, {},
        k_corners * part.strands * part.segments);
    commands.end_rendering();
    return {};
  }

  Result<void> make_parts(const Resources& resources) {
    const DrawnHair& hair = resources.get<DrawnHair>();
    if (resources.wants<SeenHair>()) {
      CUTICLE_ASSIGN(seen_, make_visibility(*device_, *resources.get<Targets>().color));
    }
    if (!parameters_of<Parameters>(resources).packed) return {};
    const std::uint32_t size = hair.vertices_per_strand;
    CUTICLE_ASSIGN(packing_, strands::GpuPacking::create(*device_, hair.strands.vertex_count / size, size));
    return {};
  }

 private:
  void begin(gpu::Commands& commands, const Resources& resources) const {
    const gpu::Commands::Target targets[] = {color_target(resources), {.color = &seen_}};
    commands.begin_rendering({targets, seen_ ? 2u : 1u}, resources.get<Targets>().depth, resources.get<Targets>().keep);
  }

  std::shared_ptr<gpu::Device> device_;
  gpu::Texture seen_;  ///< per sample the segment that it sees, from 1, where that is asked for
  std::map<float, gpu::GraphicsPipeline> pipelines_;  ///< by the width of their lines: few, see line_width
  strand_shading::ShadingInputs inputs_;
  std::optional<strands::GpuPacking> packing_;  ///< where the scene asks for it
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_ASSIGN(strand_shading::ShadingInputs inputs, strand_shading::ShadingInputs::make(device, resources));
  auto pass = std::make_unique<Lines>(std::move(device), std::move(inputs));
  CUTICLE_TRY(pass->make_parts(resources));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"lines", create};
  return table;
}

}  // namespace cuticle::render::lines
