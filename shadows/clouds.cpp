#include "shadows/clouds.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "core/result.h"

namespace cuticle::shadows {
namespace {

/// Three normally distributed numbers, by Box and Muller's transformation.
glm::dvec3 normal_point(std::mt19937_64& random) {
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  glm::dvec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    point[axis] = radius * std::cos(2 * std::numbers::pi * uniform());
  }
  return point;
}

}  // namespace

strands::Groom smoke(std::size_t points, double deviation, float radius) {
  std::mt19937_64 random(3);
  std::vector<glm::vec3> places;
  for (std::size_t i = 0; i < points; ++i) places.emplace_back(deviation * normal_point(random));
  return point_casters(places, std::span(&radius, 1));
}

strands::Groom foliage(std::size_t leaves, double deviation, double length, float radius) {
  std::mt19937_64 random(5);
  std::vector<glm::vec3> ends;
  for (std::size_t i = 0; i < leaves; ++i) {
    const glm::dvec3 middle = deviation * normal_point(random);
    const glm::dvec3 half = 0.5 * length * glm::normalize(normal_point(random));
    ends.insert(ends.end(), {glm::vec3(middle - half), glm::vec3(middle + half)});
  }
  return segment_casters(ends, std::span(&radius, 1));
}

strands::Groom point_casters(std::span<const glm::vec3> points, std::span<const float> radii) {
  std::vector<glm::vec3> ends;
  for (const glm::vec3& point : points) ends.insert(ends.end(), {point, point});
  return segment_casters(ends, radii);
}

strands::Groom segment_casters(std::span<const glm::vec3> ends, std::span<const float> radii) {
  const std::size_t count = ends.size() / 2;
  CUTICLE_EXPECT(ends.size() % 2 == 0, "a segment has two ends");
  CUTICLE_EXPECT(radii.size() == 1 || radii.size() == count, "one radius for all or one for each");
  strands::Groom groom;
  groom.positions.assign(ends.begin(), ends.end());
  for (std::size_t i = 0; i < count; ++i) {
    groom.offsets.push_back(std::uint32_t(2 * (i + 1)));
    groom.radii.insert(groom.radii.end(), 2, radii[radii.size() == 1 ? 0 : i]);
  }
  return groom;
}

}  // namespace cuticle::shadows
