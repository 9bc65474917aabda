// What a map of functions of depth has on the device.
#include <bit>

#include "shadows/map_series.h"
#include "shadows/map_shadow_gpu.h"
#include "shadows/series.glslh"

#include <map_series_comp.spv.h>

namespace cuticle::shadows {

MapDescription describe_series(const MapSettings& settings, std::uint32_t functions, const std::vector<float>& weights,
                               std::span<const std::uint32_t> lookup) {
  MapDescription map;
  map.settings = settings;
  map.intervals = float(k_series_steps);
  map.layers = functions;
  map.pieces_per_step = k_series_pieces_per_step;
  map.signed_sums = true;
  map.after_deposits = [weights](double, double) {
    std::vector<std::uint32_t> words;
    for (const float weight : weights) words.push_back(std::bit_cast<std::uint32_t>(weight));
    return words;
  };
  map.buffers = {{.per_strip = true}, {.words = std::tuple_size_v<FibreSums>, .kept = false}};
  map.passes = {{.name = "shadow.splat",
                 .code = map_series_comp,
                 .buffers = {k_vertices, k_segments, k_box, k_deposits, k_own, k_own + 1},
                 .texels = {3},
                 .per_strip = true,
                 .constants = {functions}},
                {.name = "shadow.lookup",
                 .code = lookup,
                 .buffers = {k_vertices, k_segments, k_box, k_deposits, k_own, k_own + 1, k_transmittance, k_receivers},
                 .run = MapRun::per_vertex,
                 .texels = {3, 4, 5},
                 .per_strip = true,
                 .constants = {functions}}};
  return map;
}

}  // namespace cuticle::shadows
