#include "shadows/map_series.h"

#include "shadows/detail/map_walk.h"
#include "shadows/series.glslh"

namespace cuticle::shadows {

std::vector<float> series_weights(std::size_t functions, const std::function<double(std::size_t, double)>& function) {
  std::vector<float> weights;
  for (std::uint32_t step = 0; step < k_series_steps; ++step)
    for (std::size_t i = 0; i < functions; ++i) weights.push_back(float(function(i, (step + 0.5) / k_series_steps)));
  return weights;
}

SeriesMap build_series(const strands::Groom& groom, double alpha, const LightAxes& axes, const MapSettings& settings,
                       std::size_t functions, const std::vector<float>& weights) {
  SeriesMap map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.resolution, float(k_series_steps));
  map.scale = fixed_point_scale(alpha, settings.accumulation, 2 * (groom.vertex_count() - groom.strand_count()));
  map.functions = functions;
  map.sums.resize(map.view.texels() * functions);
  const std::vector<std::uint32_t> table = deposit_table(alpha, settings.accumulation, map.scale);
  const auto deposit = [&](std::size_t texel, std::uint32_t covered, std::uint32_t step) {
    const float* at = &weights[std::min(step, k_series_steps - 1) * functions];
    for (std::size_t i = 0; i < functions; ++i)
      add_to(map.sums[texel * functions + i], std::uint32_t(weighted_amount(table[covered], at[i])));
  };
  for_each_covered_texel(map.view, groom, k_series_pieces_per_step, deposit);
  return map;
}

}  // namespace cuticle::shadows
