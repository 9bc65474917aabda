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

float SeriesMap::sum(std::size_t texel, std::size_t i, std::span<const OwnDeposit> own) const {
  std::uint32_t left = sums[texel * functions + i];
  for (const OwnDeposit& deposit : own) left -= amount(deposit.covered, deposit.step, i);
  return float(std::int32_t(left));
}

std::uint32_t SeriesMap::amount(std::uint32_t covered, std::uint32_t step, std::size_t i) const {
  return std::uint32_t(weighted_amount(table[covered], weights[std::min(step, k_series_steps - 1) * functions + i]));
}

SeriesMap build_series(const strands::Groom& groom, double alpha, const LightAxes& axes, const MapSettings& settings,
                       std::size_t functions, std::vector<float> weights) {
  SeriesMap map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.resolution, float(k_series_steps));
  map.scale = fixed_point_scale(alpha, settings.accumulation, 2 * (groom.vertex_count() - groom.strand_count()));
  map.functions = functions;
  map.sums.resize(map.view.texels() * functions);
  map.table = deposit_table(alpha, settings.accumulation, map.scale);
  map.weights = std::move(weights);
  const auto deposit = [&](std::size_t texel, std::uint32_t covered, std::uint32_t step) {
    for (std::size_t i = 0; i < functions; ++i) add_to(map.sums[texel * functions + i], map.amount(covered, step, i));
  };
  for_each_covered_texel(map.view, groom, k_series_pieces_per_step, deposit);
  map.fibre = sums_of_fibre(map.view, groom);
  return map;
}

}  // namespace cuticle::shadows
