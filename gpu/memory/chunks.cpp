#include <algorithm>

#include "gpu/device.h"

namespace cuticle::gpu {

std::vector<Chunk> chunks(std::size_t items, std::size_t bytes_each, std::uint64_t limit_bytes) {
  const std::size_t fitting = bytes_each == 0 ? items : std::size_t(limit_bytes / bytes_each);
  const std::size_t step = std::max(fitting, std::size_t(1));
  std::vector<Chunk> parts;
  for (std::size_t begin = 0; begin < items; begin += step) parts.push_back({begin, std::min(items, begin + step)});
  return parts;
}

}  // namespace cuticle::gpu
