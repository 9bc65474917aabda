#include "strands/spline/place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/growing/random.h"
#include "strands/tangent.glslh"

namespace cuticle::strands {

namespace {

constexpr std::uint64_t k_follow_seed = 20140401, k_thickness_seed = 20140402;

/// Two unit vectors across a direction and each other.
std::array<glm::vec3, 2> across(const glm::vec3& direction) {
  const glm::vec3 away = std::abs(direction.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 first = glm::normalize(glm::cross(direction, away));
  return {first, glm::cross(direction, first)};
}

}  // namespace

std::vector<PlacedStrand> placed_strands(std::size_t strands) {
  std::vector<PlacedStrand> placed(strands);
  for (std::size_t s = 0; s < strands; ++s) placed[s].guide = std::uint32_t(s);
  return placed;
}

std::vector<PlacedStrand> follow_strands(const Groom& groom, std::span<const FollowHairs> groups) {
  std::vector<PlacedStrand> placed;
  for (const FollowHairs& group : groups) {
    CUTICLE_EXPECT(group.first + group.guides <= groom.strand_count(), "guides are strands of the groom");
    for (std::size_t guide = group.first; guide < group.first + group.guides; ++guide) {
      const auto strand = groom.strand(guide);
      const auto [u, v] = across(direction_or<float>(strand[1] - strand[0], glm::vec3(0, 1, 0)));
      RandomStream chance = random_stream(k_follow_seed, Chance::follow, guide);
      for (std::size_t k = 0; k < group.per_guide; ++k) {
        const double along_u = 2 * chance.next_unit() - 1, along_v = 2 * chance.next_unit() - 1;
        placed.push_back({std::uint32_t(guide), float(group.tip_separation),
                          u * float(group.reach * along_u) + v * float(group.reach * along_v)});
      }
    }
  }
  return placed;
}

void spread_thickness(double spread, std::span<PlacedStrand> strands) {
  for (std::size_t s = 0; s < strands.size(); ++s)
    strands[s].thickness = float(1 + spread * (2 * random_stream(k_thickness_seed, Chance::follow, s).next_unit() - 1));
}

Groom place(const Groom& groom, std::span<const PlacedStrand> strands, std::uint32_t parts) {
  Groom result;
  for (const PlacedStrand& placed : strands) {
    const auto guide = groom.strand(placed.guide);
    const auto beside = [&](std::size_t k) {
      return guide[k] + placed.offset * (1 + placed.tip_separation * float(k) / float(guide.size()));
    };
    const auto radius = [&](std::size_t k) { return groom.radii[groom.offsets[placed.guide] + k] * placed.thickness; };
    for (std::size_t i = 0; !guide.empty() && i < cut_size(guide.size(), parts); ++i) {
      const std::size_t k = i / parts, next = std::min(k + 1, guide.size() - 1);
      const float share = float(i - k * parts) / float(parts);
      result.positions.push_back(share == 0 ? beside(k) : glm::mix(beside(k), beside(next), share));
      result.radii.push_back(share == 0 ? radius(k) : glm::mix(radius(k), radius(next), share));
    }
    result.offsets.push_back(std::uint32_t(result.positions.size()));
  }
  return result;
}

std::uint32_t longest_strand(const Groom& groom) {
  std::size_t longest = 2;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) longest = std::max(longest, groom.strand_size(s));
  return std::uint32_t(longest);
}

}  // namespace cuticle::strands
