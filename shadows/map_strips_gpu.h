#pragma once
// How a map that exceeds what a device holds in one buffer is cut into strips of rows.
#include <algorithm>

#include "gpu/device.h"
#include "shadows/filter.glslh"
#include "shadows/map_settings.h"

namespace cuticle::shadows {

inline constexpr std::uint32_t k_max_strips = 64;

/// How many strips, the rows beside one that its lookups read, and the most texels that one holds.
struct Strips {
  std::uint32_t count = 1, margin = 0;
  std::uint64_t texels = 0;
};

/// Rows beside a strip that its lookups read.
inline std::uint32_t margin_of(const MapSettings& settings) {
  return std::uint32_t(1 +
                       disc_reach(settings.filter_radius > 0 ? k_max_filter_radius : float(settings.filter_texels)));
}

/// As few strips as let `layers` words a texel fit into a buffer of the device; one, where the filter is too wide for
/// any number, so that the map is refused as a whole. A map is at most 4 times as wide as its resolution. Lookups read
/// most maps as texels of 4 bytes, of which a view holds fewer than a storage buffer may.
inline Strips strips_of(const MapSettings& settings, std::uint64_t layers, const gpu::DeviceInfo& device) {
  const std::uint64_t most_bytes = std::min(device.max_storage_buffer_bytes, device.max_texel_buffer_bytes / 4),
                      side = settings.resolution, all = side * side;
  const std::uint32_t margin = margin_of(settings);
  const auto held = [&](std::uint64_t count) { return count == 1 ? all : all / count + (2 * margin + 2) * 4 * side; };
  std::uint32_t count = 1;
  while (4 * layers * held(count) > most_bytes && count < k_max_strips) ++count;
  if (4 * layers * held(count) > most_bytes) count = 1;
  return {count, count == 1 ? 0 : margin, held(count)};
}

}  // namespace cuticle::shadows
