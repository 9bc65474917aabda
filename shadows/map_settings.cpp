#include <cuticle/shadows/map_settings.h>

#include <algorithm>

#include <fmt/core.h>

namespace cuticle::shadows {

namespace {

constexpr double k_widest_filter = 64;
constexpr std::uint64_t k_most_bytes = 2ull << 30;

}  // namespace

MapSettings map_settings(const registry::ParameterValues& values) {
  MapSettings settings;
  settings.resolution = std::uint32_t(values.integer("resolution"));
  if (values.all().contains("k")) settings.accumulation.k = values.real("k");
  if (values.all().contains("accumulate")) settings.accumulation.poisson = values.choice("accumulate") == "poisson";
  settings.filter_texels = values.real("filter_texels");
  settings.filter_radius = 1e-3 * values.real("filter_radius_mm");
  return settings;
}

Result<float> filter_in_texels(std::string_view method, const MapSettings& settings, double texels_per_metre) {
  const double given =
      settings.filter_radius > 0 ? std::max(0.5, settings.filter_radius * texels_per_metre) : settings.filter_texels;
  if (given <= k_widest_filter) return float(given);
  return usage_error(
      fmt::format("{}: the filter's radius is {:.0f} texels, more than {}", method, given, k_widest_filter),
      "a smaller filter_radius_mm or a lower resolution");
}

Result<void> check_map_bytes(std::string_view method, std::uint64_t numbers, std::uint32_t resolution) {
  const std::uint64_t bytes = 4 * numbers * resolution * resolution;
  if (bytes <= k_most_bytes) return {};
  return usage_error(fmt::format("{}: {} numbers a texel at resolution {} need {} bytes, more than {}", method, numbers,
                                 resolution, bytes, k_most_bytes),
                     "fewer planes or a lower resolution");
}

}  // namespace cuticle::shadows
