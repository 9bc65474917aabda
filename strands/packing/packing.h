#pragma once
// H15: strands for the graphics device in 12 bytes a vertex and 20 a strand.
#include <cstdint>
#include <vector>

#include "strands/groom.h"

namespace cuticle::strands {

/// What the halves of a strand's vertices are relative to.
struct PackedStrand {
  glm::vec3 center{0};       ///< metres
  float half_extent = 0;     ///< metres, the greatest along an axis; 0: all vertices lie at the centre
  float largest_radius = 0;  ///< metres
};
/// A vertex as packing.glslh decodes it.
struct PackedVertex {
  std::uint32_t xy = 0, z_radius = 0, tangent = 0;
};
struct PackedGroom {
  std::vector<std::uint32_t> offsets{0};
  std::vector<PackedStrand> strands;
  std::vector<PackedVertex> vertices;
};

/// Error of a coordinate over its strand's half extent, of a radius over the strand's largest (half floats in [-1, 1]
/// rounded to nearest: 2^-12), and of a unit tangent (angle, radians). Reached within 1.3 over random and extreme
/// grooms: packing_test.
inline constexpr double k_packed_position_error = 0x1p-12 * 1.01, k_packed_tangent_error = 4.9e-5;

/// Positions, radii and tangents() of a groom that validate() accepts. 12 bytes a vertex and 24 a strand with its
/// offset, against 32 a vertex for positions, radii and tangents as the renderer holds them in full.
PackedGroom pack(const Groom& groom);
/// Offsets, positions and radii; whatever else the groom had is lost.
Groom unpacked(const PackedGroom& packed);
/// Unit tangents per vertex.
std::vector<glm::vec3> unpacked_tangents(const PackedGroom& packed);
std::size_t byte_size(const PackedGroom& packed);

}  // namespace cuticle::strands
