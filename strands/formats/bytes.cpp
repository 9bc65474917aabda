#include "strands/formats/bytes.h"

#include <algorithm>

#include <fmt/core.h>

#include "strands/finite.h"

namespace cuticle::strands {

Result<void> require_floats(const ByteView& bytes, const std::string& field, std::uint64_t offset,
                            std::uint64_t count) {
  if (count <= bytes.size() && bytes.has(offset, 4 * count)) return {};
  return bytes.error(field, offset,
                     fmt::format("{} numbers need {} bytes each, the file ends after {} bytes", count, 4,
                                 bytes.size() - std::min(bytes.size(), offset)));
}

Result<void> require_finite(const ByteView& bytes, const std::string& field, std::uint64_t offset, std::uint64_t first,
                            std::span<const float> values, Damage damage) {
  if (damage == Damage::keep) return {};
  const std::size_t i = first_not_finite(values);
  if (i == values.size()) return {};
  return bytes.error(fmt::format("{}[{}]", field, first + i), offset + 4 * (first + i),
                     fmt::format("{} is not a finite number", double(values[i])));
}

}  // namespace cuticle::strands
