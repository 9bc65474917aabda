#pragma once
// Chance in growing: four uniforms per (seed, stream, index), the same in any order of asking.
#include <array>
#include <cstdint>

#include <cuticle/core/shared/philox.glslh>

namespace cuticle::strands {

enum class Stream : std::uint32_t { length = 1, clump = 2, root = 3 };

/// Four independent uniforms in [0, 1), multiples of 2^-24.
inline std::array<double, 4> uniforms(std::uint64_t seed, Stream stream, std::uint64_t index) {
  const PhiloxBlock counter{std::uint32_t(index), std::uint32_t(index >> 32), std::uint32_t(stream), 0};
  const PhiloxBlock words = philox(counter, std::uint32_t(seed), std::uint32_t(seed >> 32));
  std::array<double, 4> result{};
  unit_interval<double>(words.a, result[0]);
  unit_interval<double>(words.b, result[1]);
  unit_interval<double>(words.c, result[2]);
  unit_interval<double>(words.d, result[3]);
  return result;
}

}  // namespace cuticle::strands
