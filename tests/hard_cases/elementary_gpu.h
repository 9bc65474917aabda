#pragma once
// The elementary functions of core, and its random words, on a device.
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "gpu/device.h"

namespace cuticle::hard_cases {

/// Function `index` of elementary.glslh at each pair of arguments.
Result<std::vector<float>> elementary_gpu(gpu::Device& device, std::uint32_t index, std::span<const glm::vec2> arguments);
/// For i below count, the four words of block (i, 7 i, 1, 2) under key (3, i ^ 0x55), combined by exclusive or.
Result<std::vector<std::uint32_t>> random_words_gpu(gpu::Device& device, std::uint32_t count);

}  // namespace cuticle::hard_cases
