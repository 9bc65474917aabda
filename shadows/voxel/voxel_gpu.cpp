// The volume on the GPU: clear (fills), fit, deposit, march; the integers of the cells equal the CPU's. It is held at
// its largest, a cube.
#include <bit>

#include "shadows/map_shadow_gpu.h"
#include "shadows/voxel/volume.h"

#include <voxel_deposit_comp.spv.h>
#include <voxel_march_comp.spv.h>

namespace cuticle::shadows::voxel {
namespace {

constexpr std::uint32_t k_anisotropic_flag = 2;  // k_anisotropic of voxel_deposit.comp
constexpr int k_sums = k_own;

MapDescription description(const Settings& settings) {
  const std::uint64_t side = settings.map.resolution;
  MapDescription map;
  map.settings = settings.map;
  map.in_world = true;
  map.flags = settings.isotropic ? 0 : k_anisotropic_flag;
  map.after_deposits = [settings](double alpha, double) {
    return std::vector<std::uint32_t>{std::bit_cast<std::uint32_t>(units_per_crossing(alpha, settings)),
                                      std::bit_cast<std::uint32_t>(crossing_met_at_random(alpha, settings))};
  };
  map.buffers = {{side * side * side}};
  map.passes = {{"shadow.deposit", voxel_deposit_comp, {k_vertices, k_segments, k_box, k_deposits, k_sums}},
                {"shadow.march",
                 voxel_march_comp,
                 {k_vertices, k_segments, k_box, k_deposits, k_sums, k_transmittance, k_receivers},
                 MapRun::per_vertex}};
  return map;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"voxel", create_map<Settings, description>, words_of_map<Settings, build_volume>};
  return method;
}

}  // namespace cuticle::shadows::voxel
