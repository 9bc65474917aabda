#include "render/reference/cross_sections.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/reference/random_numbers.h"
#include "strands/spline/frames.h"

namespace cuticle::render::reference {

std::vector<CrossSections::Across> CrossSections::across(const strands::Groom& hair,
                                                         std::span<const glm::vec3> positions) {
  std::vector<Across> all;
  all.reserve(positions.size());
  for (std::uint32_t s = 0; s < hair.strand_count(); ++s) {
    const auto points = positions.subspan(hair.offsets[s], hair.offsets[s + 1] - hair.offsets[s]);
    const strands::StrandFrames frames = strands::frames_along(points, {1, 0, 0});
    float length = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k > 0) length += glm::distance(points[k - 1], points[k]);
      all.push_back({frames.normals[k], length});
    }
  }
  return all;
}

CrossSections::CrossSections(const strands::Groom& hair, std::span<const glm::vec3> positions_at_end,
                             const Turning& turning)
    : turning_(turning), at_begin_(across(hair, hair.positions)) {
  if (!positions_at_end.empty()) at_end_ = across(hair, positions_at_end);
}

void CrossSections::turn(FibrePoint& point, double time) const {
  const std::size_t v = point.from.vertex;
  const auto normal_at = [&](std::size_t vertex) {
    const glm::dvec3 begin = at_begin_[vertex].normal;
    return at_end_.empty() ? begin : glm::mix(begin, glm::dvec3(at_end_[vertex].normal), time);
  };
  const glm::dvec3 between = glm::mix(normal_at(v), normal_at(v + 1), point.share);
  const glm::dvec3 normal = between - glm::dot(between, point.x) * point.x;
  const double size = glm::length(normal);
  if (size > 1e-6) point.y = normal / size;
  point.z = glm::cross(point.x, point.y);
  const double along = glm::mix(double(at_begin_[v].length), double(at_begin_[v + 1].length), point.share);
  const double chance = double(random_numbers(turning_.seed, {point.from.strand, 0}, 0, Purpose::turn)[0]);
  const double angle = 2 * std::numbers::pi * (chance + turning_.twist * along);
  const glm::dvec3 y = point.y, z = point.z;
  point.y = std::cos(angle) * y + std::sin(angle) * z;
  point.z = std::cos(angle) * z - std::sin(angle) * y;
}

}  // namespace cuticle::render::reference
