#pragma once
// Drawn vertices may be more than one binding of a storage buffer holds. They are read as texels (drawn.glsl), whole,
// and written in parts: runs of strands, a dispatch each.
#include <algorithm>
#include <cstdint>

namespace cuticle::strands {

inline constexpr std::uint32_t k_vertex_bytes = 16;  ///< of a place with its radius, of a tangent, of a velocity
inline constexpr std::uint32_t k_color_bytes = 8;    ///< of what a vertex shows

/// Strands of a part of whose every vertex one storage binding of `binding_bytes` holds `bytes`.
constexpr std::uint32_t strands_of_a_part(std::uint64_t binding_bytes, std::uint32_t vertices_per_strand,
                                          std::uint32_t bytes) {
  constexpr std::uint64_t k_step = 32;  // strands that end at a multiple of 256 bytes, where a binding may begin
  const std::uint64_t most =
      binding_bytes / (std::uint64_t(bytes) * std::max(vertices_per_strand, 1u)) / k_step * k_step;
  return std::uint32_t(std::clamp<std::uint64_t>(most, k_step, 1u << 31));
}

/// Parts that so many strands make; at least one.
constexpr std::uint32_t parts_of_strands(std::uint64_t binding_bytes, std::uint32_t strands,
                                         std::uint32_t vertices_per_strand, std::uint32_t bytes) {
  const std::uint64_t most = strands_of_a_part(binding_bytes, vertices_per_strand, bytes);
  return std::uint32_t(std::max<std::uint64_t>(1, (strands + most - 1) / most));
}

}  // namespace cuticle::strands
