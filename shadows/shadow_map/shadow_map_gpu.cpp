// The shadow map on the GPU: clear (fills), fit, nearest, lookup; the integers of the map equal the CPU's.
#include "shadows/map_shadow_gpu.h"
#include "shadows/shadow_map/depth.glslh"
#include "shadows/shadow_map/depth_map.h"
#include "shadows/splat.glslh"

#include <shadow_map_lookup_comp.spv.h>
#include <shadow_map_nearest_comp.spv.h>

namespace cuticle::shadows::shadow_map {
namespace {

constexpr std::uint32_t k_opaque_flag = 2;  // k_opaque of shadow_map_lookup.comp
constexpr int k_nearest = k_own;

MapDescription description(const Settings& settings) {
  MapDescription map;
  map.settings = settings.map;
  map.intervals = float(k_depth_steps);
  map.flags = settings.absorbing ? 0 : k_opaque_flag;
  map.pieces_per_step = k_pieces_per_step;
  map.own = {float(settings.bias), float(settings.fibre_spacing)};
  map.after_deposits = [](double alpha, double) { return std::vector<std::uint32_t>{drawn_opacity(alpha)}; };
  map.buffers = {{std::uint64_t(settings.map.resolution) * settings.map.resolution, k_no_depth}};
  map.passes = {{"shadow.nearest", shadow_map_nearest_comp, {k_vertices, k_segments, k_box, k_deposits, k_nearest}},
                {"shadow.lookup",
                 shadow_map_lookup_comp,
                 {k_vertices, k_segments, k_box, k_deposits, k_nearest, k_transmittance, k_receivers},
                 MapRun::per_vertex}};
  return map;
}

MapWords words_of(const Map& map) { return {map.nearest}; }

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"shadow_map", create_map<Settings, description>,
                                words_of_map<Settings, build_map, words_of>};
  return method;
}

}  // namespace cuticle::shadows::shadow_map
