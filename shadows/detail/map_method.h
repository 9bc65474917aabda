#pragma once
// A method that builds a map and looks receivers up in it: its evaluation on the CPU and its entry in the registry.
#include <chrono>
#include <span>
#include <vector>

#include "core/wall_clock.h"
#include "shadows/detail/map_walk.h"
#include "shadows/light_frame.h"
#include "shadows/map_settings.h"
#include "shadows/method.h"

namespace cuticle::shadows {

/// What an integer of a map counts in the exponent of T: -k / scale.
inline float exponent_per_unit(const MapSettings& settings, double scale) {
  return float(-settings.accumulation.k / scale);
}

/// How lookups in the map average. Error: usage, for a filter too wide for it.
inline Result<MapFilter> map_filter(const MapView& view, const MapSettings& settings) {
  CUTICLE_ASSIGN(const float radius, filter_in_texels(settings, double(view.scale.x)));
  return MapFilter{radius, float(settings.filter_radius), float(settings.depth_offset), settings.accumulation.poisson,
                   settings.knows_depths};
}

/// Transmittance at the receivers. at_depth(i, z, power) gives, for receiver i with its LookupPlace::power, a function
/// of a texel and of what the receiver's own fibre has left there: the exponent of T before depth z without that;
/// depths are limited to 0 .. deepest, in steps. Pieces of fibres are at most 1 / steps_to_pieces steps deep. Error:
/// usage, for a filter too wide for the map.
Result<std::vector<float>> look_up_receivers(const MapView& view, const MapSettings& settings, float deepest,
                                             float steps_to_pieces, const Asked& asked, const auto& at_depth) {
  CUTICLE_ASSIGN(const MapFilter filter, map_filter(view, settings));
  std::vector<float> values(asked.receivers.points.size());
  for_each_index(values.size(), [&](std::size_t i) {
    thread_local OwnFibre own_fibre;
    const auto own = own_vertex(asked.groom, asked.receivers, i);
    const auto find_own = [&](const glm::vec3& seen, const glm::vec2& at, float radius) {
      own_fibre.leave_none();
      if (own) own_fibre.find(view, asked.groom, *own, seen, at, radius, steps_to_pieces);
    };
    const LookupPlace place = lookup_place(asked, asked.receivers.points[i], own, view.axes);
    values[i] = transmittance_at(view, filter, deepest, place, own_fibre, find_own,
                                 [&](float z) { return at_depth(i, z, place.power); });
  });
  return values;
}

/// Method::evaluate of a method of maps, from its Settings, build(groom, alpha, axes, settings) and
/// look_up(map, settings, asked), each a value or a Result of one. Errors: those of `check` and of these.
template <class Settings, auto build, auto look_up>
Result<Transmittance> evaluate_map(const Casters& casters, const Receivers& receivers,
                                   const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from<Settings>(values));
  CUTICLE_TRY(check(casters, receivers));
  CUTICLE_ASSIGN(const LightAxes axes, axes_of(casters));
  Transmittance result;
  const auto start = std::chrono::steady_clock::now();
  CUTICLE_ASSIGN(const auto map, Result(build(*casters.groom, casters.alpha, axes, settings)));
  result.cost.build_ms = milliseconds_since(start);
  const auto built = std::chrono::steady_clock::now();
  CUTICLE_ASSIGN(result.values, Result(look_up(map, settings, Asked{*casters.groom, receivers})));
  result.cost.lookup_ms = milliseconds_since(built);
  result.cost.bytes = map.bytes();
  result.cost.device = cpu_device_name();
  if constexpr (requires { map.clamped; }) result.clamped = map.clamped;
  return result;
}

/// Entry::dispatches of a method with so many passes for each light.
template <std::uint32_t passes>
std::uint32_t passes_per_light(const registry::ParameterValues&, const registry::FrameShape& shape) {
  return passes * shape.lights;
}

/// The registered method of what evaluate_map takes; `entry` says what is its own, and may say its demands.
template <class Settings, auto build, auto look_up>
Method map_method(registry::Entry entry, decltype(Method::is_proportional) is_proportional = nullptr) {
  static constexpr std::string_view k_demands[] = {"light", "shadow_method"};
  entry.kind = registry::EntryKind::method;
  if (entry.demands.empty()) entry.demands = k_demands;
  entry.stage = registry::Stage::shadow;
  entry.parameters = registry::table_of<Settings>();
  return {entry, evaluate_map<Settings, build, look_up>, is_proportional};
}

}  // namespace cuticle::shadows
