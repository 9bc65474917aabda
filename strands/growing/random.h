#pragma once
// Chance in growing: a stream of its own for every purpose and index, the same in any order of asking.
#include "core/random.h"

namespace cuticle::strands {

enum class Chance : std::uint64_t { length = 1, clump = 2, root = 3, bun = 4, lock = 5, follow = 7, shaping = 16 };

/// `index` below 2^48.
inline RandomStream random_stream(std::uint64_t seed, Chance purpose, std::uint64_t index) {
  return RandomStream(seed, (std::uint64_t(purpose) << 48) | index);
}

}  // namespace cuticle::strands
