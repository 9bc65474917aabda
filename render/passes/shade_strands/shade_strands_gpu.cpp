#include "render/passes/shade_strands/shade_strands_gpu.h"

#include <cmath>

#include "gpu/groups.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/dual_scattering/dual_scattering_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/seen_vertices/seen_vertices_gpu.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"
#include "render/strand_shading/shading_inputs_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <shade_choose_comp.spv.h>
#include <shade_fill_comp.spv.h>
#include <shade_strands_comp.spv.h>

namespace cuticle::render::shade_strands {

namespace {

/// As the shaders read them.
struct ChoosePush {
  glm::vec3 eye;
  float points_per_size;
  std::uint32_t strand_count, vertices_per_strand, only_visible;
};
struct ShadePush {
  std::uint32_t only_visible, first_vertex, part_vertices, listed;
};
struct FillPush {
  std::uint32_t first_vertex, part_vertices, vertices_per_strand;
  float tip_variation;
  std::uint32_t only_visible;
};

struct Kernels {
  gpu::Kernel choose, shade, fill;
};
struct Buffers {
  gpu::Buffer colors, points, shaded;
  std::vector<strands::StrandPart> parts;  ///< of the colours: a dispatch writes one
};

class ShadeStrands : public GpuPass {
 public:
  ShadeStrands(Kernels kernels, strand_shading::ShadingInputs inputs, Buffers buffers, double point_px)
      : kernels_(std::move(kernels)), inputs_(std::move(inputs)), buffers_(std::move(buffers)), point_px_(point_px) {}

  void publish(Resources& resources) const override {
    resources.put(StrandColors{&buffers_.colors, point_px_ > 0 ? &buffers_.shaded : nullptr});
  }

  Result<bool> take_parameters(const Resources& resources) override { return inputs_.take_parameters(resources); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    inputs_.update(resources);
    CUTICLE_TRY(inputs_.record(commands, resources, listed_seen(resources)));
    // What does not show is blended with no weight, which takes a number.
    if (resources.find<seen_vertices::SeenVertices>()) commands.fill(buffers_.colors, 0);
    if (point_px_ > 0) record_choose(commands, resources);
    for (const strands::StrandPart& part : buffers_.parts) record_shade(commands, resources, part);
    if (point_px_ > 0)
      for (const strands::StrandPart& part : buffers_.parts) record_fill(commands, resources, part);
    return {};
  }

 private:
  static std::uint32_t only_visible(const Resources& resources) {
    return resources.find<tile_lists::TileLists>() ? 1 : 0;
  }
  const gpu::Buffer& visible(const Resources& resources) const {
    if (const auto* const seen = resources.find<seen_vertices::SeenVertices>()) return seen->bits;
    return resources.find<tile_lists::TileLists>() ? resources.get<tile_lists::TileLists>().visible : inputs_.frame();
  }

  /// The list of those that show; null: there is none, or shading points are chosen among them.
  const gpu::Buffer* listed_seen(const Resources& resources) const {
    const auto* const seen = resources.find<seen_vertices::SeenVertices>();
    return seen && !(point_px_ > 0) ? &seen->list : nullptr;
  }

  void record_choose(gpu::Commands& commands, const Resources& resources) const {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const Camera& camera = resources.get<FrameView>().camera;
    const double pixels = camera.resolution.y / (2 * std::tan(camera.vertical_field_of_view / 2));  // a metre at one
    const std::uint32_t strands = hair.strands.vertex_count / hair.vertices_per_strand;
    const ChoosePush push{glm::vec3(camera.position), float(pixels / point_px_), strands, hair.vertices_per_strand,
                          only_visible(resources)};
    const gpu::Groups groups = gpu::groups_for(strands);
    commands.fill(buffers_.shaded, 0);
    commands.dispatch(kernels_.choose, {hair.strands.vertices, &visible(resources), &buffers_.points, &buffers_.shaded},
                      {}, gpu::bytes_of(push), groups.x, groups.y);
  }

  void record_shade(gpu::Commands& commands, const Resources& resources, const strands::StrandPart& part) const {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const gpu::Buffer* const listed = listed_seen(resources);
    const std::uint32_t own = part.count * part.vertices_per_strand, by_points = point_px_ > 0 ? 1 : 0;
    const ShadePush push{only_visible(resources), part.first * part.vertices_per_strand, own, listed ? 2u : by_points};
    const gpu::Groups groups = gpu::groups_for(push.listed == 1 ? hair.strands.vertex_count : own);
    const gpu::Buffer colors = part.of(buffers_.colors);
    const dual_scattering::Inputs dual = dual_scattering::inputs_of(resources, inputs_.frame());
    const gpu::Buffer* const buffers[] = {hair.strands.vertices,
                                          hair.tangents,
                                          &colors,
                                          &inputs_.frame(),
                                          &inputs_.transmittance(),
                                          &visible(resources),
                                          listed ? listed : &buffers_.shaded,
                                          dual.terms,
                                          dual.visibility,
                                          &inputs_.scattered()};
    const gpu::Texture* const tables[] = {inputs_.table(resources, 0), inputs_.table(resources, 1),
                                          inputs_.table(resources, 2)};
    if (listed) {
      commands.dispatch_counted(kernels_.shade, buffers, tables, gpu::bytes_of(push), *listed,
                                seen_vertices::k_listed_groups);
    } else {
      commands.dispatch(kernels_.shade, buffers, tables, gpu::bytes_of(push), groups.x, groups.y);
    }
  }

  void record_fill(gpu::Commands& commands, const Resources& resources, const strands::StrandPart& part) const {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const FillPush push{part.first * part.vertices_per_strand, part.count * part.vertices_per_strand,
                        part.vertices_per_strand, float(parameters_of<lines::Parameters>(resources).tip_variation),
                        only_visible(resources)};
    const gpu::Groups groups = gpu::groups_for(push.part_vertices);
    const gpu::Buffer colors = part.of(buffers_.colors);
    commands.dispatch(kernels_.fill, {hair.tangents, &visible(resources), &buffers_.points, &colors}, {},
                      gpu::bytes_of(push), groups.x, groups.y);
  }

  Kernels kernels_;
  strand_shading::ShadingInputs inputs_;
  Buffers buffers_;
  double point_px_;
};

Result<Kernels> make_kernels(gpu::Device& device, const Resources& resources) {
  Kernels kernels;
  CUTICLE_ASSIGN(kernels.choose,
                 device.make_kernel(shade_choose_comp, {4, 0, sizeof(ChoosePush), {}, {strands::drawn_texels(0)}}));
  std::vector<std::uint32_t> constants =
      with_channels(dual_scattering::with_dual_scattering({}, resources), transmittance_of(resources).channels);
  constants.push_back(resources.get<FibreMaterial>().evaluates_directly ? 1 : 0);
  constants = strand_shading::with_layout(std::move(constants), bake_tables::table_set_of(resources));
  CUTICLE_ASSIGN(kernels.shade,
                 device.make_kernel(shade_strands_comp, {10,
                                                         3,
                                                         sizeof(ShadePush),
                                                         constants,
                                                         {strands::drawn_texels(0), strands::drawn_texels(1),
                                                          GatheredTransmittance::texels(4)}}));
  CUTICLE_ASSIGN(kernels.fill,
                 device.make_kernel(shade_fill_comp, {4, 0, sizeof(FillPush), {}, {strands::drawn_texels(0)}}));
  return kernels;
}

/// Without shading points the last two take their places only.
Result<Buffers> make_buffers(gpu::Device& device, const Resources& resources, bool by_points) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  const std::size_t vertices = hair.strands.vertex_count, word = sizeof(std::uint32_t);
  Buffers buffers;
  static_assert(strands::k_color_bytes == sizeof(glm::uvec2));
  CUTICLE_ASSIGN(buffers.colors,
                 device.make_texel_buffer(vertices * strands::k_color_bytes, gpu::TextureFormat::rgba16f));
  buffers.parts = strands::strand_parts(device.info(), std::uint32_t(vertices / hair.vertices_per_strand),
                                        hair.vertices_per_strand, strands::k_color_bytes);
  CUTICLE_ASSIGN(buffers.points, device.make_buffer(by_points ? vertices / hair.vertices_per_strand * word : word));
  CUTICLE_ASSIGN(buffers.shaded, device.make_buffer((seen_vertices::k_list_head + (by_points ? vertices : 1)) * word));
  return buffers;
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const double point_px = parameters_of<Parameters>(resources).point_px;
  CUTICLE_ASSIGN(Kernels kernels, make_kernels(*device, resources));
  CUTICLE_ASSIGN(Buffers buffers, make_buffers(*device, resources, point_px > 0));
  CUTICLE_ASSIGN(strand_shading::ShadingInputs inputs,
                 strand_shading::ShadingInputs::make(std::move(device), resources));
  return std::unique_ptr<GpuPass>(
      std::make_unique<ShadeStrands>(std::move(kernels), std::move(inputs), std::move(buffers), point_px));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"shade_strands", create};
  return table;
}

}  // namespace cuticle::render::shade_strands
