#pragma once
// What the methods that look up a map of the light's view have in common: parameters and their SI values.
#include <cstdint>
#include <string_view>

#include "core/registry/members.h"
#include "core/result.h"
#include "shadows/deposit.h"

namespace cuticle::shadows {

inline constexpr std::string_view k_accumulations[] = {"optical_depth", "poisson"};

/// Parameters in SI units, of which a method describes those that it has.
struct MapSettings {
  std::string_view method;         ///< whose, for errors
  std::uint32_t resolution = 256;  ///< the map has at most its square of texels
  Accumulation accumulation{};
  double filter_texels = 1;  ///< radius of the lookup's disc; under 0.5: the one texel that holds the point
  double filter_radius = 0;  ///< the same in metres, at least half a texel; used instead where it is not 0
  double depth_offset = 0;   ///< metres
  bool knows_depths = true;  ///< of hair; else how much of it an interval of depth holds
  std::uint32_t room_mib = 512;
  std::uint64_t list_room() const {
    return std::uint64_t(room_mib) << 20;
  }  ///< bytes for fragments on a device, at most
};
void describe_resolution(registry::Members& members, MapSettings& map);
void describe_filter(registry::Members& members, MapSettings& map);
/// Resolution, filter, depth offset, and how opacity is summed.
void describe(registry::Members& members, MapSettings& map);
void describe_room(registry::Members& members, MapSettings& map);

/// A method's settings. Errors: those of their own `check`, where they have one.
template <class Settings>
Result<Settings> settings_from(const registry::ParameterValues& values) {
  const auto settings = registry::from_values<Settings>(values);
  if constexpr (requires { settings.check(); }) {
    CUTICLE_TRY(settings.check());
  }
  return settings;
}

/// Method::is_proportional of a method whose sums are looked up as they are.
template <class Settings>
bool is_poisson(const registry::ParameterValues& values) {
  return registry::from_values<Settings>(values).map.accumulation.poisson;
}

/// The lookup's disc in texels. Error: usage, naming the method's filter, for more than 128.
Result<float> filter_in_texels(const MapSettings& settings, double texels_per_metre);

/// Error: usage, naming the method, when `numbers` of 4 bytes a texel pass 2 GiB.
Result<void> check_map_bytes(const MapSettings& settings, std::uint64_t numbers);

}  // namespace cuticle::shadows
