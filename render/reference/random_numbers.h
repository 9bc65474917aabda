#pragma once
// The random numbers of a path: blocks of Philox by pixel, sample, scattering and purpose, so that a sample is the same
// whoever draws it and whenever.
#include <array>
#include <cstdint>

#include "core/shared/philox.glslh"

namespace cuticle::render::reference {

/// What four numbers are drawn for.
enum class Purpose : std::uint32_t { direction, ending, light, surroundings, camera, lens, time, shadow, turn };

struct PathName {
  std::uint32_t pixel = 0, sample = 0;
};

/// Four numbers in [0, 1), multiples of 2^-24.
inline std::array<float, 4> random_numbers(std::uint64_t seed, PathName path, int scattering, Purpose purpose) {
  const PhiloxBlock counter{path.pixel, path.sample, std::uint32_t(scattering), std::uint32_t(purpose)};
  const PhiloxBlock words = philox(counter, std::uint32_t(seed), std::uint32_t(seed >> 32));
  const auto unit = [](std::uint32_t word) { return float(word >> 8) * 0x1p-24f; };
  return {unit(words.a), unit(words.b), unit(words.c), unit(words.d)};
}

}  // namespace cuticle::render::reference
