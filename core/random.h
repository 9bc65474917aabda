#pragma once
// A stream of random numbers on the CPU, drawn from the counter-based generator that the GPU uses too.
#include "core/shared/philox.glslh"

namespace cuticle {

/// Stream `stream` of `seed`: number n of a stream is always the same, on every machine, and streams do not overlap.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::uint64_t stream = 0) : seed_(seed), stream_(stream) {}

  std::uint32_t next_word() {
    const std::uint32_t lane = std::uint32_t(drawn_ % 4);
    if (lane == 0) block_ = block(drawn_ / 4);
    ++drawn_;
    return lane == 0 ? block_.a : lane == 1 ? block_.b : lane == 2 ? block_.c : block_.d;
  }
  /// In [0, 1), a multiple of 2^-53.
  double next_unit() {
    const std::uint64_t high = next_word() >> 5, low = next_word() >> 6;
    return double((high << 26) | low) * 0x1p-53;
  }

 private:
  PhiloxBlock block(std::uint64_t index) const {
    const PhiloxBlock counter{uint(index), uint(index >> 32), uint(stream_), uint(stream_ >> 32)};
    return philox(counter, uint(seed_), uint(seed_ >> 32));
  }

  std::uint64_t seed_, stream_, drawn_ = 0;
  PhiloxBlock block_{};
};

}  // namespace cuticle
