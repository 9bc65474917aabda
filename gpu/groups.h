#pragma once
// How many workgroups a kernel over a list is dispatched in: one thread for each item.
#include <cstddef>
#include <cstdint>

namespace cuticle::gpu {

inline constexpr std::uint32_t k_threads = 64;  ///< of a workgroup, in every kernel over a list: its local_size_x

/// Workgroups for so many threads; past what Vulkan promises on one axis (65,535) spread over two. The kernel finds its
/// item by `invocation` of gpu/groups.glsl and leaves numbers past the end alone.
struct Groups {
  std::uint32_t x = 0, y = 1;
};
constexpr Groups groups_for(std::size_t threads) {
  constexpr std::size_t k_row = 32768;
  const std::size_t count = (threads + k_threads - 1) / k_threads;
  if (count <= k_row) return {std::uint32_t(count), 1};
  return {std::uint32_t(k_row), std::uint32_t((count + k_row - 1) / k_row)};
}

}  // namespace cuticle::gpu
