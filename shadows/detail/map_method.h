#pragma once
// The CPU evaluation of a method that builds a map of the light's view and looks receivers up in it.
#include <chrono>
#include <span>
#include <vector>

#include <cuticle/shadows/detail/map_walk.h>
#include <cuticle/shadows/light_frame.h>
#include <cuticle/shadows/map_settings.h>
#include <cuticle/shadows/method.h>

namespace cuticle::shadows {

/// Milliseconds of wall clock since `start`.
inline double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Transmittance at world points from sum_at(texel, depth), integers of `scale` per unit of sigma; depths are limited
/// to 0 .. deepest, in steps. `filter`: radius in texels.
std::vector<float> look_up_points(const MapView& view, const MapSettings& settings, double scale, float filter,
                                  float deepest, std::span<const glm::vec3> points, const auto& sum_at) {
  std::vector<float> values(points.size());
  const MapFilter around{filter, settings.accumulation.poisson};
  const float per_unit = float(-settings.accumulation.k / scale);
  const auto exponent = [&](std::size_t texel, float z) { return per_unit * sum_at(texel, z); };
  for_each_index(points.size(),
                 [&](std::size_t i) { values[i] = transmittance_at(view, around, deepest, points[i], exponent); });
  return values;
}

/// build(groom, alpha, axes, settings) gives a map with its `view` (or a Result of one), look_up(map, settings, filter,
/// points) a float per point, bytes(map) its size. Errors: those of `check`, and of a filter too wide for the map.
template <class Settings>
Result<Transmittance> evaluate_by_map(std::string_view name, const Casters& casters, const Receivers& receivers,
                                      const Settings& settings, const auto& build, const auto& look_up,
                                      const auto& bytes) {
  CUTICLE_TRY(check(casters, receivers));
  CUTICLE_ASSIGN(const glm::dvec3 to_light, unit_to_light(casters.to_light));
  Transmittance result;
  const auto start = std::chrono::steady_clock::now();
  CUTICLE_ASSIGN(const auto map, Result(build(*casters.groom, casters.alpha, light_axes(to_light), settings)));
  CUTICLE_ASSIGN(const float filter, filter_in_texels(name, settings.map, double(map.view.scale.x)));
  result.cost.build_ms = milliseconds_since(start);
  const auto built = std::chrono::steady_clock::now();
  result.values = look_up(map, settings, filter, receivers.points);
  result.cost.lookup_ms = milliseconds_since(built);
  result.cost.bytes = bytes(map);
  result.cost.device = cpu_device_name();
  if constexpr (requires { map.clamped; }) result.clamped = map.clamped;
  return result;
}

}  // namespace cuticle::shadows
