#include "strands/cards/occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/spline/frame.glslh"

namespace cuticle::strands {

namespace {

constexpr int k_cells = 64;           ///< along the longest side
constexpr float k_solid = 1e6f;       ///< extinction of a cell of the head, 1/m
constexpr float k_clear_of_head = 2;  ///< cells that a ray from a root has to leave the head
constexpr float k_darkest = 20;       ///< optical depth at which a ray ends

/// Extinction per cell of a box.
class Extinction {
 public:
  Extinction(const Groom& groom, const Mesh* head) {
    const Bounds box = bounds(groom);
    const glm::vec3 size = box.upper - box.lower;
    cell_ = std::max({size.x, size.y, size.z, 1e-6f}) / float(k_cells);
    lower_ = box.lower - cell_;
    count_ = glm::ivec3(size / cell_) + 3;
    fibres_.resize(std::size_t(count_.x) * std::size_t(count_.y) * std::size_t(count_.z));
    for (std::size_t s = 0; s < groom.strand_count(); ++s) add_strand(groom, s);
    if (head) add_head(*head);
  }

  /// Optical depth from a point to the end of the box.
  float depth_along(const glm::vec3& from, const glm::vec3& direction) const {
    const glm::vec3 start = (from - lower_) / cell_;
    const auto [enters, leaves] = within_box(start, direction);
    float depth = 0;
    for (float step = enters + 0.5f; step < leaves && depth < k_darkest; ++step) {
      const glm::vec3 place = start + direction * step;
      if (!holds(place)) continue;  // rounding at the box's sides
      const std::size_t i = index(place);
      depth += cell_ * fibres_[i];
      if (step > k_clear_of_head && !solid_.empty() && solid_[i]) depth += cell_ * k_solid;
    }
    return depth;
  }

 private:
  /// Cells along a ray at which it enters the box, 0 or more, and leaves it.
  std::pair<float, float> within_box(const glm::vec3& start, const glm::vec3& direction) const {
    float enters = 0, leaves = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
      const float speed = std::copysign(std::max(std::abs(direction[axis]), 1e-9f), direction[axis]);
      const float a = -start[axis] / speed, b = (float(count_[axis]) - start[axis]) / speed;
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    }
    return {enters, leaves};
  }

  bool holds(const glm::vec3& place) const {
    return place.x >= 0 && place.y >= 0 && place.z >= 0 && place.x < float(count_.x) && place.y < float(count_.y) &&
           place.z < float(count_.z);
  }
  std::size_t index(const glm::vec3& place) const {
    const glm::ivec3 c(place);
    return (std::size_t(c.z) * std::size_t(count_.y) + std::size_t(c.y)) * std::size_t(count_.x) + std::size_t(c.x);
  }

  /// In pieces of half a cell.
  void add_strand(const Groom& groom, std::size_t s) {
    const float per_area = float(std::numbers::pi / 4) / (cell_ * cell_ * cell_);
    for (std::uint32_t v = groom.offsets[s] + 1; v < groom.offsets[s + 1]; ++v) {
      const glm::vec3 a = groom.positions[v - 1], b = groom.positions[v];
      const float length = glm::distance(a, b);
      const int pieces = 1 + int(2 * length / cell_);
      const float each = per_area * (groom.radii[v - 1] + groom.radii[v]) * length / float(pieces);
      for (int k = 0; k < pieces; ++k)
        fibres_[index((glm::mix(a, b, (float(k) + 0.5f) / float(pieces)) - lower_) / cell_)] += each;
    }
  }

  void add_head(const Mesh& head) {
    solid_.resize(fibres_.size());
    for (const auto& [a, b, c] : head.triangles) add_triangle(head.positions[a], head.positions[b], head.positions[c]);
  }

  void add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const int pieces = 1 + int(2 * std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}) / cell_);
    for (int i = 0; i <= pieces; ++i)
      for (int j = 0; i + j <= pieces; ++j) {
        const glm::vec3 point = a + (b - a) * (float(i) / float(pieces)) + (c - a) * (float(j) / float(pieces));
        if (const glm::vec3 place = (point - lower_) / cell_; holds(place)) solid_[index(place)] = 1;
      }
  }

  float cell_ = 1;
  glm::vec3 lower_{0};
  glm::ivec3 count_{0};
  std::vector<float> fibres_;        ///< 1/m
  std::vector<std::uint8_t> solid_;  ///< 1: the head's surface passes; empty: no head
};

/// Directions about +z with a density of their cosine, along a spiral.
std::vector<glm::vec3> cosine_directions(int count) {
  std::vector<glm::vec3> directions;
  for (int k = 0; k < count; ++k) {
    const double square = (k + 0.5) / count, turn = 2 * std::numbers::pi * std::fmod(k * std::numbers::phi, 1.0);
    const double flat = std::sqrt(square);
    directions.emplace_back(flat * std::cos(turn), flat * std::sin(turn), std::sqrt(1 - square));
  }
  return directions;
}

}  // namespace

std::vector<float> ambient_occlusion(const Groom& groom, const Mesh* head, std::span<const glm::vec3> points,
                                     std::span<const glm::vec3> normals, int rays) {
  const Extinction extinction(groom, head);
  const std::vector<glm::vec3> directions = cosine_directions(rays);
  std::vector<float> open;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const glm::vec3 x = any_across<float>(normals[k]), y = glm::cross(normals[k], x);
    float sum = 0;
    for (const glm::vec3& d : directions)
      sum += std::exp(-extinction.depth_along(points[k], d.x * x + d.y * y + d.z * normals[k]));
    open.push_back(sum / float(rays));
  }
  return open;
}

}  // namespace cuticle::strands
