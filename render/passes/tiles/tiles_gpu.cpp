#include <cuticle/render/passes/tile_lists/tile_lists_gpu.h>
#include <cuticle/render/passes/tile_sort/tile_sort.h>

#include <resolve_vert.spv.h>
#include <tiles_comp.spv.h>
#include <tiles_frag.spv.h>
#include <tiles_sliced_comp.spv.h>
#include <tiles_subgroup_comp.spv.h>

namespace cuticle::render::tiles {

namespace {

/// As tiles.frag reads it.
struct MergePush {
  std::uint32_t width, supersampling;
  float inverse_near, inverse_far;
};

class Tiles : public GpuPass {
 public:
  Tiles(gpu::Kernel fine, gpu::GraphicsPipeline merge, gpu::Buffer picture, gpu::Buffer depth, gpu::Buffer seen)
      : fine_(std::move(fine)),
        merge_(std::move(merge)),
        picture_(std::move(picture)),
        depth_(std::move(depth)),
        seen_(std::move(seen)) {}

  void publish(FrameResources& resources) const override { resources.seen = &seen_; }

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    const tile_lists::TileLists& lists = *resources.tile_lists;
    const tile_lists::TilePush push = push_of(resources, lists);
    std::vector<const gpu::Buffer*> buffers = {resources.strands.vertices,
                                               resources.strand_colors,
                                               &lists.offsets,
                                               &lists.sorted,
                                               &lists.scene_depth,
                                               &picture_,
                                               &depth_,
                                               &seen_};
    if (push.slices > 0) buffers.push_back(&lists.depth_ranges);
    commands.dispatch(fine_, buffers, {}, gpu::bytes_of(push), lists.grid.x, lists.grid.y);
    const MergePush merge{push.part.x, std::uint32_t(resources.supersampling), push.inverse_near,
                          push.inverse_far};
    begin_target(commands, resources);
    commands.draw(merge_, {&picture_, &depth_}, {}, gpu::bytes_of(merge), 3);
    commands.end_rendering();
    return {};
  }

 private:
  gpu::Kernel fine_;
  gpu::GraphicsPipeline merge_;
  gpu::Buffer picture_, depth_, seen_;
};

/// By slices where the scene asks for them, else as sorted: where a subgroup is a tile's eight, they speak within it.
Result<gpu::Kernel> make_fine(gpu::Device& device, const FrameResources& resources) {
  const bool sliced = parameters_of(resources, tile_sort::entry()).integer("slices") > 0;
  const gpu::ShaderInterface interface {
    sliced ? 9u : 8u, 0, sizeof(tile_lists::TilePush), { resources.says_seen ? 1u : 0u }
  };
  if (sliced) return device.make_kernel(tiles_sliced_comp, interface);
  const bool subgroup = device.info().subgroup_size == tile_lists::k_tile && device.info().subgroup_broadcast;
  return subgroup ? device.make_kernel(tiles_subgroup_comp, interface) : device.make_kernel(tiles_comp, interface);
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  const std::size_t pixels = std::size_t(drawn_size(resources).x) * std::size_t(drawn_size(resources).y);
  gpu::GraphicsDescription description = target_description(resources);
  description.vertex_spirv = resolve_vert;
  description.fragment_spirv = tiles_frag;
  description.interface.storage_buffers = 2;
  description.interface.push_constant_bytes = sizeof(MergePush);
  description.blend = gpu::BlendMode::alpha;
  CUTICLE_ASSIGN(gpu::GraphicsPipeline merge, device->make_graphics(description));
  CUTICLE_ASSIGN(gpu::Kernel fine, make_fine(*device, resources));
  CUTICLE_ASSIGN(gpu::Buffer picture, device->make_buffer(pixels * sizeof(glm::uvec2)));
  CUTICLE_ASSIGN(gpu::Buffer depth, device->make_buffer(pixels * sizeof(float)));
  CUTICLE_ASSIGN(gpu::Buffer seen, make_seen(*device, resources));
  return std::unique_ptr<GpuPass>(std::make_unique<Tiles>(std::move(fine), std::move(merge), std::move(picture),
                                                          std::move(depth), std::move(seen)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"tiles", create};
  return table;
}

}  // namespace cuticle::render::tiles
