#include "render/passes/tile_lists/tile_lists_gpu.h"

#include <tile_sort_comp.spv.h>

namespace cuticle::render::tile_sort {

namespace {

class TileSort : public GpuPass {
 public:
  explicit TileSort(gpu::Kernel kernel) : kernel_(std::move(kernel)) {}

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const tile_lists::TileLists& lists = resources.get<tile_lists::TileLists>();
    commands.dispatch(kernel_, {&lists.offsets, &lists.entries, &lists.sorted, &lists.depth_ranges}, {},
                      gpu::bytes_of(push_of(resources, lists)), lists.grid.x, lists.grid.y);
    return {};
  }

 private:
  gpu::Kernel kernel_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources&) {
  CUTICLE_ASSIGN(gpu::Kernel kernel,
                 device->make_kernel(tile_sort_comp, {4, 0, sizeof(tile_lists::TilePush), {}, {{1}}}));
  return std::unique_ptr<GpuPass>(std::make_unique<TileSort>(std::move(kernel)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"tile_sort", create};
  return table;
}

}  // namespace cuticle::render::tile_sort
