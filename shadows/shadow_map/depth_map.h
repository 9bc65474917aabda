#pragma once
// An ordinary shadow map: the depth of each texel's nearest fibre, tested against a receiver's.
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "shadows/map_settings.h"
#include "shadows/map_view.h"
#include "shadows/own_fibre.h"
#include "strands/groom.h"

namespace cuticle::shadows::shadow_map {

/// The method's parameters, in SI units.
struct Settings {
  MapSettings map{.method = "shadow_map", .resolution = 2048};  // a word a texel: texels are what counts
  double bias = 0;                                              ///< metres
  bool absorbing = false;       ///< hair absorbs along its depth; else a fibre lets nothing pass
  double fibre_spacing = 1e-3;  ///< metres of depth for each fibre that absorbs
  Result<void> check() const { return check_map_bytes(map, 1); }
};
void describe(registry::Members& members, Settings& settings);

struct Map {
  MapView view;
  float crossing = 0;                  ///< optical depth of one crossing
  std::vector<std::uint32_t> nearest;  ///< depth step of each texel's nearest fibre, or k_no_depth
  std::size_t bytes() const { return 4 * nearest.size(); }
};
/// An opacity, 0 .. 1, in the numbers of is_drawn().
std::uint32_t drawn_opacity(double alpha);
/// Fills a map; the same integers at any thread count, and as the GPU's (MapGpu_SameGroom_SameIntegers).
Map build_map(const strands::Groom& groom, double alpha, const LightAxes& axes, const Settings& settings);

/// Transmittance at the receivers, one each, in [0, 1]; outside the map it is 1. A texel whose nearest fibre is the
/// receiver's own, or lies behind that, lets the light through. Error: usage, for too wide a filter.
Result<std::vector<float>> look_up(const Map& map, const Settings& settings, const Asked& asked);

}  // namespace cuticle::shadows::shadow_map
