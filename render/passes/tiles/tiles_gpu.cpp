#include "render/passes/seen_vertices/seen_vertices_gpu.h"
#include "render/passes/shade_strands/shade_strands_gpu.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"
#include "render/passes/tile_sort/tile_sort.h"
#include "render/passes/tiles/tiles.h"
#include "render/passes/tiles/tiles_shares_gpu.h"

#include <tiles_comp.spv.h>
#include <tiles_frag.spv.h>
#include <tiles_records_comp.spv.h>
#include <tiles_sliced_comp.spv.h>
#include <tiles_spans_comp.spv.h>
#include <tiles_spans_records_comp.spv.h>
#include <tiles_vert.spv.h>

namespace cuticle::render::tiles {

namespace {

/// As tiles.vert and tiles.frag read it.
struct MergePush {
  glm::uvec2 part;
  float per_sample, inverse_near, inverse_far;
};

constexpr std::uint32_t k_merged_run = 8;  // tiles, k_run of tiles.vert

/// The fine rasteriser, and what projects segments for it where it reads records; else it does so itself.
struct Fine {
  gpu::Kernel draw;
  FineForm form;
  Records own;                    ///< where no pass before has made them
  const Records* made = nullptr;  ///< by `seen_vertices`
  const Records& records() const { return made ? *made : own; }
};

class Tiles : public GpuPass {
 public:
  Tiles(std::shared_ptr<gpu::Device> device, Fine fine, gpu::GraphicsPipeline merge, gpu::Buffer picture,
        gpu::Buffer depth, gpu::Buffer seen)
      : device_(std::move(device)),
        fine_(std::move(fine)),
        merge_(std::move(merge)),
        picture_(std::move(picture)),
        depth_(std::move(depth)),
        seen_(std::move(seen)) {}

  void publish(Resources& resources) const override { resources.put(SeenHair{.pixels = &seen_}); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const tile_lists::TileLists& lists = resources.get<tile_lists::TileLists>();
    const tile_lists::TilePush push = push_of(resources, lists);
    if (fine_.form.reads_records)
      fine_.records().record(commands, resources, push, resources.get<shade_strands::StrandColors>().values);
    for (const gpu::Buffer* cleared : {&picture_, &seen_}) commands.fill(*cleared, 0);
    std::vector<const gpu::Buffer*> buffers = buffers_of(resources);
    if (push.slices > 0) buffers.push_back(&lists.depth_ranges);
    commands.dispatch(fine_.draw, buffers, {}, gpu::bytes_of(push), lists.grid.x, lists.grid.y);
    const MergePush merge{push.part, 1 / float(resources.get<Targets>().supersampling), push.inverse_near,
                          push.inverse_far};
    begin_target(commands, resources);
    const std::uint32_t runs = (lists.grid.x + k_merged_run - 1) / k_merged_run * lists.grid.y;
    commands.draw(merge_, {&picture_, &depth_, &lists.offsets}, {}, gpu::bytes_of(merge), 6 * runs);
    commands.end_rendering();
    return {};
  }

  Result<std::optional<SeenStrands>> seen_strands(const Resources& resources) override {
    const tile_lists::TileLists& lists = resources.get<tile_lists::TileLists>();
    const tile_lists::TilePush push = push_of(resources, lists);
    SeenStrands seen;
    CUTICLE_ASSIGN(seen.shares, shares_of_tiles(*device_, fine_.form, buffers_of(resources), push, lists.grid));
    CUTICLE_ASSIGN(seen.behind,
                   gpu::read_buffer<float>(*device_, lists.scene_depth, std::size_t(push.part.x) * push.part.y));
    for (float& depth : seen.behind) depth = depth > 0 ? 1 / depth : 0;
    return std::optional(std::move(seen));
  }

 private:
  /// Bindings 0 .. 7 of the fine rasteriser.
  std::vector<const gpu::Buffer*> buffers_of(const Resources& resources) const {
    const tile_lists::TileLists& lists = resources.get<tile_lists::TileLists>();
    const gpu::Buffer* const vertices = resources.get<DrawnHair>().strands.vertices;
    return {fine_.form.reads_records ? &fine_.records().all() : vertices,
            resources.get<shade_strands::StrandColors>().values,
            &lists.offsets,
            &lists.sorted,
            &lists.scene_depth,
            &picture_,
            &depth_,
            &seen_};
  }

  std::shared_ptr<gpu::Device> device_;
  Fine fine_;
  gpu::GraphicsPipeline merge_;
  gpu::Buffer picture_, depth_, seen_;
};

std::span<const std::uint32_t> fine_code(bool sliced, bool spans, bool reads_records) {
  using Code = std::span<const std::uint32_t>;
  if (sliced) return tiles_sliced_comp;
  if (spans) return reads_records ? Code(tiles_spans_records_comp) : Code(tiles_spans_comp);
  return reads_records ? Code(tiles_records_comp) : Code(tiles_comp);
}

/// By slices where the scene asks for them, else as sorted.
Result<Fine> make_fine(gpu::Device& device, const Resources& resources) {
  const bool sliced = parameters_of<tile_sort::Parameters>(resources).slices > 0;
  Fine fine;
  fine.form = fine_form(device.info(), resources);
  const gpu::ShaderInterface interface = fine_interface(fine.form, sliced ? 9 : 8, resources.wants<SeenHair>());
  CUTICLE_ASSIGN(fine.draw, device.make_kernel(fine_code(sliced, fine.form.spans, fine.form.reads_records), interface));
  if (const auto* const seen = resources.find<seen_vertices::SeenVertices>())
    fine.made = &seen->records;
  else if (fine.form.reads_records) {
    CUTICLE_ASSIGN(fine.own, Records::make(device, resources));
  }
  return fine;
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const std::size_t pixels = std::size_t(drawn_size(resources).x) * std::size_t(drawn_size(resources).y);
  gpu::GraphicsDescription description = target_description(resources);
  description.vertex_spirv = tiles_vert;
  description.fragment_spirv = tiles_frag;
  description.interface.storage_buffers = 3;
  description.interface.texels = {{0, gpu::TextureFormat::rgba16f}, {1, gpu::TextureFormat::r32f}};
  description.interface.push_constant_bytes = sizeof(MergePush);
  description.blend = gpu::BlendMode::alpha;
  CUTICLE_ASSIGN(gpu::GraphicsPipeline merge, device->make_graphics(description));
  CUTICLE_ASSIGN(Fine fine, make_fine(*device, resources));
  CUTICLE_ASSIGN(gpu::Buffer picture, device->make_buffer(pixels * sizeof(glm::uvec2)));
  CUTICLE_ASSIGN(gpu::Buffer depth, device->make_buffer(pixels * sizeof(float)));
  CUTICLE_ASSIGN(gpu::Buffer seen, make_seen(*device, resources));
  return std::unique_ptr<GpuPass>(std::make_unique<Tiles>(device, std::move(fine), std::move(merge), std::move(picture),
                                                          std::move(depth), std::move(seen)));
}

/// The fine rasteriser, and what projects segments for it.
std::uint32_t dispatches(const gpu::DeviceInfo& device, const PassParameters& parameters,
                         const registry::FrameShape& shape) {
  return 1 + prepare_dispatches(device, parameters, shape);
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"tiles", create, dispatches};
  return table;
}

}  // namespace cuticle::render::tiles
