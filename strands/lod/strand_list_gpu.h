#pragma once
// A list of strands on the device, made by a kernel and read by those that follow without a word to the CPU.
#include <array>

#include "gpu/device.h"

namespace cuticle::strands {

/// 32-bit words: how many strands, vertices of each (0: no list, all strands count), workgroups of 64 threads over
/// their vertices (three axes) and over their segments, then the strands' numbers, ascending. As strand_list.glsl has
/// them.
inline constexpr std::size_t k_list_head = 8;
/// Where Commands::dispatch_counted finds the workgroups, bytes.
inline constexpr std::size_t k_listed_vertex_groups = 8, k_listed_segment_groups = 20;

/// What kernels bind where nothing makes a list.
inline Result<gpu::Buffer> make_no_strand_list(gpu::Device& device) {
  constexpr std::array<std::uint32_t, k_list_head + 1> nothing{};
  return gpu::make_buffer_from<std::uint32_t>(device, nothing);
}

}  // namespace cuticle::strands
