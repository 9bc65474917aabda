#include "strands/packing/packing.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "strands/packing/packing.glslh"

namespace cuticle::strands {

namespace {

std::uint32_t half_bits(double value, double unit) { return unit > 0 ? glm::packHalf1x16(float(value / unit)) : 0u; }

PackedStrand strand_of(const Groom& groom, std::size_t s) {
  const auto points = groom.strand(s);
  glm::dvec3 lower(points[0]), upper(points[0]);
  PackedStrand strand;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lower = glm::min(lower, glm::dvec3(points[i]));
    upper = glm::max(upper, glm::dvec3(points[i]));
    strand.largest_radius = std::max(strand.largest_radius, groom.radii[groom.offsets[s] + i]);
  }
  strand.center = glm::vec3(0.5 * (lower + upper));
  // From the centre as it is stored, so that no coordinate passes 1 by more than rounding.
  const glm::dvec3 side = glm::max(upper - glm::dvec3(strand.center), glm::dvec3(strand.center) - lower);
  strand.half_extent = float(std::max({side.x, side.y, side.z}));
  return strand;
}

PackedVertex vertex_of(const glm::vec3& position, float radius, const glm::vec3& tangent, const PackedStrand& strand) {
  const glm::dvec3 offset = glm::dvec3(position) - glm::dvec3(strand.center);
  const auto unit = double(strand.half_extent);
  return {half_bits(offset.x, unit) | half_bits(offset.y, unit) << 16,
          half_bits(offset.z, unit) | half_bits(double(radius), double(strand.largest_radius)) << 16,
          packed_tangent<double>(glm::normalize(glm::dvec3(tangent)))};
}

}  // namespace

PackedGroom pack(const Groom& groom) {
  PackedGroom packed;
  packed.offsets = groom.offsets;
  packed.vertices.reserve(groom.vertex_count());
  const std::vector<glm::vec3> directions = tangents(groom);
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    packed.strands.push_back(strand_of(groom, s));
    for (std::size_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v)
      packed.vertices.push_back(vertex_of(groom.positions[v], groom.radii[v], directions[v], packed.strands.back()));
  }
  return packed;
}

Groom unpacked(const PackedGroom& packed) {
  Groom groom;
  groom.offsets = packed.offsets;
  for (std::size_t s = 0; s < packed.strands.size(); ++s) {
    const PackedStrand& strand = packed.strands[s];
    for (std::size_t v = packed.offsets[s]; v < packed.offsets[s + 1]; ++v) {
      const PackedVertex& vertex = packed.vertices[v];
      groom.positions.emplace_back(
          unpacked_length<float>(vertex.xy & 0xffffu, strand.center.x, strand.half_extent),
          unpacked_length<float>(vertex.xy >> 16, strand.center.y, strand.half_extent),
          unpacked_length<float>(vertex.z_radius & 0xffffu, strand.center.z, strand.half_extent));
      groom.radii.push_back(unpacked_length<float>(vertex.z_radius >> 16, 0, strand.largest_radius));
    }
  }
  return groom;
}

std::vector<glm::vec3> unpacked_tangents(const PackedGroom& packed) {
  std::vector<glm::vec3> result;
  for (const PackedVertex& vertex : packed.vertices) result.push_back(unpacked_tangent<float>(vertex.tangent));
  return result;
}

std::size_t byte_size(const PackedGroom& packed) {
  return packed.offsets.size() * sizeof(std::uint32_t) + packed.strands.size() * sizeof(PackedStrand) +
         packed.vertices.size() * sizeof(PackedVertex);
}

}  // namespace cuticle::strands
