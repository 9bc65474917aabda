#include <cuticle/strands/formats/bytes.h>

#include <cmath>

#include <fmt/core.h>

namespace cuticle::strands {

Result<std::vector<float>> read_floats(const ByteView& bytes, const std::string& field, std::uint64_t offset,
                                       std::uint64_t count) {
  if (!bytes.has(offset, 4 * count))
    return bytes.error(field, offset,
                       fmt::format("{} numbers need {} bytes, the file ends after {}", count, 4 * count,
                                   bytes.size() - std::min(bytes.size(), offset)));
  std::vector<float> values(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    values[i] = bytes.at<float>(offset + 4 * i);
    if (!std::isfinite(values[i]))
      return bytes.error(fmt::format("{}[{}]", field, i), offset + 4 * i,
                         fmt::format("{} is not a finite number", double(values[i])));
  }
  return values;
}

}  // namespace cuticle::strands
