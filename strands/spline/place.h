#pragma once
// Strands drawn as they are given: their own vertices, and follow hairs beside guides.
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "strands/formats/format.h"
#include "strands/groom.h"

namespace cuticle::strands {

/// A drawn strand: a strand of the groom, or beside one.
struct PlacedStrand {
  std::uint32_t guide = 0;
  float tip_separation = 0;  ///< vertex k of n lies 1 + this * k / n times the offset from the guide's
  glm::vec3 offset{0};       ///< from the guide's root, metres, in the rest pose; 0: the guide itself
  float thickness = 1;       ///< times the guide's radii
  bool operator==(const PlacedStrand&) const = default;
};

/// Each strand itself.
std::vector<PlacedStrand> placed_strands(std::size_t strands);
/// The follow hairs of a groom's guides: roots by chance in a square of twice the reach about the guide's, across its
/// first segment (TressFX 3 and 4: GenerateFollowHairs). The same for the same groom.
std::vector<PlacedStrand> follow_strands(const Groom& groom, std::span<const FollowHairs> groups);
/// Thicknesses by chance in 1 - spread .. 1 + spread.
void spread_thickness(double spread, std::span<PlacedStrand> strands);
/// The strands in the rest pose, each segment of a guide cut into `parts` of one length (1 or more); radii are their
/// guides', linear in between. Roots and attributes are dropped.
Groom place(const Groom& groom, std::span<const PlacedStrand> strands, std::uint32_t parts = 1);
/// Vertices of a strand of `vertices` (2 or more) whose segments are cut so.
inline std::size_t cut_size(std::size_t vertices, std::uint32_t parts) { return (vertices - 1) * parts + 1; }
/// Vertices of the longest strand; at least 2.
std::uint32_t longest_strand(const Groom& groom);

}  // namespace cuticle::strands
