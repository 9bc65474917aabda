#include "render/passes/tile_lists/tile_lists_gpu.h"

#include <algorithm>

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

/// Lanes, and bins of each: on a GPU so many that most hold few entries, an odd number of each lane, so that these read
/// theirs from different banks of shared memory. 28 KiB of it.
std::vector<std::uint32_t> sizes_of(const gpu::DeviceInfo& device, std::uint32_t lanes_of_tile) {
  if (lanes_of_tile == tile_lists::k_tile) return {8, 64};
  return {std::min(256u, device.max_workgroup_invocations), 23};
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const std::vector<std::uint32_t> sizes =
      sizes_of(device->info(), tile_lists::lanes_of(device->info(), resources.parameters));
  CUTICLE_ASSIGN(gpu::Kernel kernel,
                 device->make_kernel(tile_sort_comp, {4, 0, sizeof(tile_lists::TilePush), sizes, {{1}}}));
  return std::unique_ptr<GpuPass>(std::make_unique<TileSort>(std::move(kernel)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"tile_sort", create};
  return table;
}

}  // namespace cuticle::render::tile_sort
