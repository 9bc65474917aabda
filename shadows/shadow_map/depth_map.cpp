#include "shadows/shadow_map/depth_map.h"

#include <algorithm>

#include "shadows/detail/map_method.h"
#include "shadows/shadow_map/depth.glslh"

namespace cuticle::shadows::shadow_map {

namespace {

bool is_own(std::uint32_t nearest, std::span<const OwnDeposit> own) {
  return std::ranges::any_of(own, [&](const OwnDeposit& deposit) { return deposit.step <= nearest; });
}

}  // namespace

Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  Map map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.map.resolution, float(k_depth_steps));
  const double scale = fixed_point_scale(alpha, settings.map.accumulation, 1);
  map.crossing =
      float(deposit_table(alpha, settings.map.accumulation, scale).back() * settings.map.accumulation.k / scale);
  map.nearest = nearest_depths(map.view, groom, k_pieces_per_step);
  return map;
}

Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked) {
  const float bias = float(settings.bias), steps_per_metre = map.view.scale.z;
  const float spacing = float(settings.fibre_spacing) * steps_per_metre;
  const auto at_depth = [&](std::size_t, float z, float) {
    return [&, z](std::size_t texel, std::span<const OwnDeposit> own) {
      if (map.nearest[texel] == k_no_depth || is_own(map.nearest[texel], own)) return 0.0f;
      const float behind = steps_behind(z, map.nearest[texel], bias, steps_per_metre);
      return -depth_behind(behind, !settings.absorbing, map.crossing, spacing);
    };
  };
  return look_up_receivers(map.view, settings.map, k_deepest, k_pieces_per_step, asked, at_depth);
}

}  // namespace cuticle::shadows::shadow_map
