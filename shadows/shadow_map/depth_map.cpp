#include "shadows/shadow_map/depth_map.h"

#include <algorithm>
#include <cmath>

#include "shadows/detail/map_method.h"
#include "shadows/shadow_map/depth.glslh"

namespace cuticle::shadows::shadow_map {

namespace {

/// Of opaque fibres: each texel's nearest step among those that hold its centre; or k_no_depth.
void draw_centres(Map& map, const strands::Groom& groom, std::uint32_t opacity) {
  const MapView& view = map.view;
  for_each_piece(view, groom, k_pieces_per_step, [&](std::uint32_t v, const Footprint<float>& footprint) {
    for_each_texel(view, footprint, [&](int i, int j) {
      const glm::vec2 offset = texel_offset(footprint.from, i, j);
      const std::size_t texel = texel_index(view, i, j);
      if (coverage_index(coverage(footprint, offset)) > 0 && holds_point(footprint, offset) &&
          is_drawn(v, std::uint32_t(texel), opacity))
        lower_to(map.nearest[texel], std::uint32_t(std::max(0, depth_bin(footprint, offset))));
    });
  });
}

/// Where hair absorbs along its depth: that of all that cover a part of the texel.
void draw_covered(Map& map, const strands::Groom& groom) {
  for_each_covered_texel(map.view, groom, k_pieces_per_step, [&](std::size_t texel, std::uint32_t, std::uint32_t step) {
    lower_to(map.nearest[texel], step);
  });
}

}  // namespace

std::uint32_t drawn_opacity(double alpha) { return std::uint32_t(std::lround(alpha * k_whole_opacity)); }

Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings) {
  Map map;
  map.view = map_view(axes, light_box(axes, groom.positions), settings.map.resolution, float(k_depth_steps));
  const double scale = fixed_point_scale(alpha, settings.map.accumulation, 1);
  map.crossing =
      float(deposit_table(alpha, settings.map.accumulation, scale).back() * settings.map.accumulation.k / scale);
  map.nearest.assign(map.view.texels(), k_no_depth);
  if (settings.absorbing)
    draw_covered(map, groom);
  else
    draw_centres(map, groom, drawn_opacity(alpha));
  return map;
}

Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked) {
  const float bias = float(settings.bias), steps_per_metre = map.view.scale.z;
  const float spacing = float(settings.fibre_spacing) * steps_per_metre;
  const auto is_own = [&](std::uint32_t nearest, std::span<const OwnDeposit> own) {
    return std::ranges::any_of(own, [&](const OwnDeposit& deposit) {
      return (deposit.is_at_centre || settings.absorbing) && deposit.step <= nearest;
    });
  };
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
