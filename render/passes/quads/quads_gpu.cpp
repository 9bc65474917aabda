#include <cmath>

#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/cull_strands/cull_strands_gpu.h"
#include "render/passes/dual_scattering/dual_scattering_gpu.h"
#include "render/passes/quads/quads.h"
#include "render/strand_shading/shading_inputs_gpu.h"
#include "render/visibility/drawn_part_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <quads_frag.spv.h>
#include <quads_shade_many_frag.spv.h>
#include <quads_shade_one_frag.spv.h>
#include <quads_vert.spv.h>
#include <resolve_vert.spv.h>

namespace cuticle::render::quads {

namespace {

constexpr int k_taper_texels = 64;

class Quads : public GpuPass {
 public:
  explicit Quads(strand_shading::ShadingInputs inputs) : inputs_(std::move(inputs)) {}

  void publish(Resources& resources) const override { resources.put(SeenHair{.samples = &seen_}); }

  Result<void> make_parts(gpu::Device& device, const Resources& resources) {
    CUTICLE_ASSIGN(seen_, make_visibility(device, *resources.get<Targets>().color));
    CUTICLE_TRY(make_taper(device, resources));
    return make_pipelines(device, resources);
  }

  Result<bool> take_parameters(const Resources& resources) override { return inputs_.take_parameters(resources); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const DrawnHair& hair = resources.get<DrawnHair>();
    strand_shading::Frame& frame = inputs_.update(resources);
    const visibility::DrawnPart part = visibility::drawn_part(resources, parameters_of<Parameters>(resources).full_px);
    frame.drawn_segments = part.segments;
    CUTICLE_TRY(inputs_.record(commands, resources));
    see(commands, resources, part);
    const gpu::Commands::Target target = color_target(resources);
    commands.begin_rendering({&target, 1}, nullptr);
    const dual_scattering::Inputs dual = dual_scattering::inputs_of(resources, inputs_.frame());
    commands.draw(shade_,
                  {hair.strands.vertices, hair.tangents, &inputs_.transmittance(), &inputs_.frame(), dual.terms,
                   dual.visibility, &inputs_.scattered()},
                  {inputs_.table(resources, 0), inputs_.table(resources, 1), inputs_.table(resources, 2), &seen_}, {},
                  3);
    commands.end_rendering();
    return {};
  }

 private:
  Result<void> make_taper(gpu::Device& device, const Resources& resources) {
    const auto parameters = parameters_of<Parameters>(resources);
    const double root = parameters.root_width, tip = parameters.tip_width;
    std::vector<float> texels;
    for (int k = 0; k < k_taper_texels; ++k) {
      const double along = std::pow(double(k) / (k_taper_texels - 1), parameters.taper_power);
      texels.insert(texels.end(), {float(root + (tip - root) * along), 0, 0, 0});
    }
    CUTICLE_ASSIGN(taper_, device.make_texture({.size = {k_taper_texels, 1}}));
    return device.upload(taper_, texels);
  }

  Result<void> make_pipelines(gpu::Device& device, const Resources& resources) {
    gpu::GraphicsDescription description = target_description(resources);
    description.vertex_spirv = quads_vert;
    description.fragment_spirv = quads_frag;
    description.interface = {.storage_buffers = 5,
                             .textures = 1,
                             .push_constant_bytes = sizeof(float),
                             .specialization = {cull_strands::is_listed(resources)},
                             .texels = {strands::drawn_texels(0), strands::drawn_texels(1)}};
    description.color_formats = {seen_.format()};
    CUTICLE_ASSIGN(see_, device.make_graphics(description));
    const int samples = seen_.samples();
    description = target_description(resources);
    description.depth_test = description.depth_write = false;
    description.vertex_spirv = resolve_vert;
    description.fragment_spirv = samples > 1 ? std::span<const std::uint32_t>(quads_shade_many_frag)
                                             : std::span<const std::uint32_t>(quads_shade_one_frag);
    std::vector<std::uint32_t> constants = dual_scattering::with_dual_scattering(
        with_channels({std::uint32_t(samples)}, transmittance_of(resources).channels), resources);
    constants.push_back(resources.get<FibreMaterial>().evaluates_directly ? 1 : 0);
    description.interface = {
        .storage_buffers = 7,
        .textures = 4,
        .specialization = strand_shading::with_layout(std::move(constants), bake_tables::table_set_of(resources)),
        .texels = {strands::drawn_texels(0), strands::drawn_texels(1), GatheredTransmittance::texels(2)}};
    CUTICLE_ASSIGN(shade_, device.make_graphics(description));
    return {};
  }

  /// The visibility buffer, in front of what was drawn before.
  void see(gpu::Commands& commands, const Resources& resources, const visibility::DrawnPart& part) const {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const Targets& targets = resources.get<Targets>();
    const gpu::Commands::Target target{.color = &seen_};
    const float width = float(part.width);
    commands.begin_rendering({&target, 1}, targets.depth, targets.keep);
    cull_strands::draw(commands, resources, see_,
                       {hair.strands.vertices, hair.tangents, &inputs_.frame(), &inputs_.frame(),
                        &cull_strands::list_of(resources, inputs_.frame())},
                       {&taper_}, gpu::bytes_of(width), k_corners * part.strands * part.segments);
    commands.end_rendering();
  }

  strand_shading::ShadingInputs inputs_;
  gpu::GraphicsPipeline see_, shade_;
  gpu::Texture seen_;  ///< per sample the segment that it sees, from 1
  gpu::Texture taper_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_ASSIGN(strand_shading::ShadingInputs inputs, strand_shading::ShadingInputs::make(device, resources));
  auto pass = std::make_unique<Quads>(std::move(inputs));
  CUTICLE_TRY(pass->make_parts(*device, resources));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"quads", create};
  return table;
}

}  // namespace cuticle::render::quads
