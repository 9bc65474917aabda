#pragma once
// What the methods that look up a map of the light's view have in common: parameters and their SI values.
#include <cstdint>
#include <string_view>

#include "core/registry/parameter.h"
#include "core/result.h"
#include "shadows/deposit.h"

namespace cuticle::shadows {

inline constexpr std::string_view k_accumulations[] = {"optical_depth", "poisson"};
inline constexpr registry::Parameter k_resolution{
    "resolution",
    registry::ParameterType::integer,
    "1",
    16,
    4096,
    "256",
    {},
    "the map has at most its square of texels, in the shape of the hair"};
inline constexpr registry::Parameter k_optical_k{
    "k", registry::ParameterType::real, "1", 0.1, 100, "5.5", {}, "sigma = optical depth / k, T = exp(-k sigma)"};
inline constexpr registry::Parameter k_filter_texels{"filter_texels",
                                                     registry::ParameterType::real,
                                                     "1",
                                                     0,
                                                     64,
                                                     "1",
                                                     {},
                                                     "radius of the disc that a lookup averages; below 0.5 one texel"};
inline constexpr registry::Parameter k_filter_radius{
    "filter_radius_mm",
    registry::ParameterType::real,
    "mm",
    0,
    1000,
    "0",
    {},
    "the same in millimetres, at least half a texel; used instead where it is not 0"};
inline constexpr registry::Parameter k_accumulate{
    "accumulate",
    registry::ParameterType::choice,
    "1",
    0,
    0,
    "optical_depth",
    k_accumulations,
    "optical_depth: sum -ln(1 - alpha c), average T; poisson: sum alpha c, average sigma"};

/// Method::is_proportional of a method whose sums are looked up as they are.
inline bool is_poisson(const registry::ParameterValues& values) { return values.choice("accumulate") == "poisson"; }

inline constexpr registry::Parameter k_depth_offset{"depth_offset_mm",
                                                    registry::ParameterType::real,
                                                    "mm",
                                                    -1000,
                                                    1000,
                                                    "0",
                                                    {},
                                                    "fibres whose axes lie up to this far behind a point still count; "
                                                    "pi/4 of the radius: those that the point's disc cuts; below 0: "
                                                    "those nearer than this before it do not"};

inline constexpr registry::Parameter k_list_room{
    "room_mib",
    registry::ParameterType::integer,
    "MiB",
    1,
    2048,
    "64",
    {},
    "memory for fragments on a GPU, which leaves out those that find no room; the CPU takes what it needs"};

/// Values of the parameters above, in SI units.
struct MapSettings {
  std::string_view method;         ///< whose, for errors
  std::uint32_t resolution = 256;  ///< the map has at most its square of texels
  Accumulation accumulation;
  double filter_texels = 1;  ///< radius of the lookup's disc; under 0.5: the one texel that holds the point
  double filter_radius = 0;  ///< the same in metres, at least half a texel; used instead where it is not 0
  double depth_offset = 0;   ///< metres
  std::uint64_t list_room = 64 << 20;  ///< bytes for fragments on a device
};
/// Of those that a method does not have, the values above.
MapSettings map_settings(std::string_view method, const registry::ParameterValues& values);

/// The lookup's disc in texels. Error: usage, naming the method's filter, for more than 128.
Result<float> filter_in_texels(const MapSettings& settings, double texels_per_metre);

/// Error: usage, naming the method, when `numbers` of 4 bytes a texel pass 2 GiB.
Result<void> check_map_bytes(const MapSettings& settings, std::uint64_t numbers);

}  // namespace cuticle::shadows
