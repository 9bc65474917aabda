#include "shadows/map_settings.h"

#include <algorithm>

#include <fmt/core.h>

#include "shadows/filter.glslh"

namespace cuticle::shadows {

namespace {

constexpr std::uint64_t k_max_bytes = 2ull << 30;

}  // namespace

void describe_resolution(registry::Members& members, MapSettings& map) {
  members(map.resolution, "resolution", 16, 4096, "the map has at most its square of texels, in the shape of the hair");
}

void describe_filter(registry::Members& members, MapSettings& map) {
  members(map.filter_texels, "filter_texels", "1", 0, 64,
          "radius of the disc that a lookup averages; below 0.5 one texel");
  members.millimetres(map.filter_radius, "filter_radius_mm", 0, 1000,
                      "the same in millimetres, at least half a texel; used instead where it is not 0");
}

void describe(registry::Members& members, MapSettings& map) {
  describe_resolution(members, map);
  members(map.accumulation.k, "k", "1", 0.1, 100, "sigma = optical depth / k, T = exp(-k sigma)");
  describe_filter(members, map);
  members.millimetres(map.depth_offset, "depth_offset_mm", -1000, 1000,
                      "fibres whose axes lie up to this far behind the depth at which a point is looked up still "
                      "count; below 0: those nearer than this before it do not. 0: those that hold the point do not");
  members(map.accumulation.poisson, "accumulate", k_accumulations,
          "optical_depth: sum -ln(1 - alpha c), average T; poisson: sum alpha c, average sigma");
}

void describe_room(registry::Members& members, MapSettings& map) {
  members(map.room_mib, registry::row("room_mib", "MiB", 1, 2048,
                                      "memory for fragments on a GPU, at most; those of a larger map come in strips "
                                      "of rows, one after the other. The CPU takes what it needs"));
}

Result<float> filter_in_texels(const MapSettings& settings, double texels_per_metre) {
  const double given =
      settings.filter_radius > 0 ? std::max(0.5, settings.filter_radius * texels_per_metre) : settings.filter_texels;
  if (given <= double(k_max_filter_radius)) return float(given);
  return usage_error(fmt::format("{}: the filter's radius is {:.0f} texels, more than {}", settings.method, given,
                                 k_max_filter_radius),
                     "a smaller filter_radius_mm or a lower resolution");
}

Result<void> check_map_bytes(const MapSettings& settings, std::uint64_t numbers) {
  const std::uint64_t bytes = 4 * numbers * settings.resolution * settings.resolution;
  if (bytes <= k_max_bytes) return {};
  return usage_error(fmt::format("{}: {} numbers a texel at resolution {} need {} bytes, more than {}", settings.method,
                                 numbers, settings.resolution, bytes, k_max_bytes),
                     "fewer planes or a lower resolution");
}

}  // namespace cuticle::shadows
