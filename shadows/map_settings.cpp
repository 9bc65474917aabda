#include "shadows/map_settings.h"

#include <algorithm>

#include <fmt/core.h>

#include "shadows/filter.glslh"

namespace cuticle::shadows {

namespace {

constexpr std::uint64_t k_most_bytes = 2ull << 30;

}  // namespace

MapSettings map_settings(std::string_view method, const registry::ParameterValues& values) {
  MapSettings settings;
  settings.method = method;
  settings.resolution = std::uint32_t(values.integer("resolution"));
  if (values.all().contains("k")) settings.accumulation.k = values.real("k");
  if (values.all().contains("accumulate")) settings.accumulation.poisson = values.choice("accumulate") == "poisson";
  if (values.all().contains("filter_texels")) settings.filter_texels = values.real("filter_texels");
  settings.filter_radius = 1e-3 * values.real("filter_radius_mm");
  if (values.all().contains("depth_offset_mm")) settings.depth_offset = 1e-3 * values.real("depth_offset_mm");
  if (values.all().contains("room_mib")) settings.list_room = std::uint64_t(values.integer("room_mib")) << 20;
  return settings;
}

Result<float> filter_in_texels(const MapSettings& settings, double texels_per_metre) {
  const double given =
      settings.filter_radius > 0 ? std::max(0.5, settings.filter_radius * texels_per_metre) : settings.filter_texels;
  if (given <= double(k_widest_filter)) return float(given);
  return usage_error(
      fmt::format("{}: the filter's radius is {:.0f} texels, more than {}", settings.method, given, k_widest_filter),
      "a smaller filter_radius_mm or a lower resolution");
}

Result<void> check_map_bytes(const MapSettings& settings, std::uint64_t numbers) {
  const std::uint64_t bytes = 4 * numbers * settings.resolution * settings.resolution;
  if (bytes <= k_most_bytes) return {};
  return usage_error(fmt::format("{}: {} numbers a texel at resolution {} need {} bytes, more than {}", settings.method,
                                 numbers, settings.resolution, bytes, k_most_bytes),
                     "fewer planes or a lower resolution");
}

}  // namespace cuticle::shadows
