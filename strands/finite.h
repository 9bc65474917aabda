#pragma once
// Whether many numbers are finite, at the speed of memory.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cuticle::strands {

/// By the exponent's bits, in blocks without a branch, so that the compiler vectorises.
inline bool all_finite(std::span<const float> values) {
  constexpr std::size_t block = 4096;
  for (std::size_t begin = 0; begin < values.size(); begin += block) {
    const std::size_t end = std::min(begin + block, values.size());
    std::uint32_t bad = 0;
    for (std::size_t i = begin; i < end; ++i)
      bad |= std::uint32_t((std::bit_cast<std::uint32_t>(values[i]) & 0x7f800000u) == 0x7f800000u);
    if (bad) return false;
  }
  return true;
}

/// Index of the first value that is not finite; the size where all are.
inline std::size_t first_not_finite(std::span<const float> values) {
  if (all_finite(values)) return values.size();
  const auto found = std::find_if_not(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
  return std::size_t(found - values.begin());
}

}  // namespace cuticle::strands
