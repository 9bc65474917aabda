#pragma once
// Strands and rays that the tests of this folder share.
#include <cmath>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "strands/groom.h"

namespace cuticle::strands {

/// Strands of one radius.
inline Groom groom_of(const std::vector<std::vector<glm::vec3>>& strands, float radius) {
  Groom groom;
  for (const auto& strand : strands) {
    groom.positions.insert(groom.positions.end(), strand.begin(), strand.end());
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), radius);
  return groom;
}

struct TestRay {
  glm::dvec3 origin, direction;
};
/// Through a slab 0.1 x 0.1 x 0.02 m.
inline std::vector<TestRay> slab_rays(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<TestRay> rays;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 origin(0.1 * unit(random), 0.1 * unit(random), -0.05);
    rays.push_back({origin, glm::normalize(glm::dvec3(unit(random) - 0.5, unit(random) - 0.5, 1))});
  }
  return rays;
}

/// Coils of segments of 1 mm in the same slab, as curly hair has them.
inline Groom random_coils(std::size_t count, float radius) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<std::vector<glm::vec3>> strands(count);
  for (auto& strand : strands) {
    const glm::vec3 start{0.1f * unit(random), 0.1f * unit(random), 0.02f * unit(random)};  // in braces: in this order
    const glm::vec3 axis = glm::normalize(glm::vec3{unit(random), unit(random), unit(random)} - 0.5f);
    const glm::vec3 side = glm::normalize(glm::cross(axis, glm::vec3(0.3f, 1, 0.2f))), up = glm::cross(axis, side);
    for (int i = 0; i < 25; ++i) {
      const float turn = 0.35f * float(i);
      strand.push_back(start + 4e-4f * float(i) * axis + 2.6e-3f * (std::cos(turn) * side + std::sin(turn) * up));
    }
  }
  return groom_of(strands, radius);
}

}  // namespace cuticle::strands
