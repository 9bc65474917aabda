#include "sim/colliders/placed.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "sim/colliders/field_sample.glslh"

namespace cuticle::sim {
namespace {

Placement placement_of(const glm::dmat4& rigid) {
  return {glm::normalize(glm::quat_cast(glm::dmat3(rigid))), glm::dvec3(rigid[3])};
}

Placement on(const Placement& outer, const Placement& inner) {
  return {glm::normalize(outer.rotation * inner.rotation), outer.of(inner.position)};
}

double distance_to(const Sphere& sphere, const glm::dvec3& place) {
  return glm::distance(place, sphere.center) - sphere.radius;
}

double distance_to(const RoundedBox& box, const glm::dvec3& place) {
  const glm::dvec3 over = glm::abs(glm::transpose(box.axes) * (place - box.center)) - box.half_size;
  const double inside = std::min(std::max({over.x, over.y, over.z}), 0.0);
  return glm::length(glm::max(over, glm::dvec3(0))) + inside - box.radius;
}

double distance_to(const FieldPointer& field, const glm::dvec3& place) {
  const glm::dvec3 cells(field->cells);
  const glm::dvec3 wanted = (place - field->centre) / field->spacing + 0.5 * cells;
  const glm::dvec3 nearest = glm::clamp(wanted, glm::dvec3(0), cells);
  return trilinear(field->values.data(), nearest, cells).distance + field->spacing * glm::distance(wanted, nearest);
}

}  // namespace

std::vector<PlacedCollider> placed_colliders(const FrameInput& input) {
  const Placement head = input.skinned.empty() ? placement_of(input.head_end) : Placement{};
  std::vector<PlacedCollider> placed;
  for (const Sphere& sphere : input.colliders) placed.push_back({sphere, head});
  for (const RoundedBox& box : input.boxes) placed.push_back({box, head});
  for (const FieldPointer& field : input.fields) placed.push_back({field, head});
  for (const MovingCollider& moving : input.moving) {
    const Placement own = moving.motion.at(input.clock_end);
    placed.push_back({moving.shape, moving.on_head ? on(head, own) : own});
  }
  return placed;
}

double distance(const PlacedCollider& collider, const glm::dvec3& place) {
  const glm::dvec3 own = glm::conjugate(collider.place.rotation) * (place - collider.place.position);
  return std::visit([&](const auto& shape) { return distance_to(shape, own); }, collider.shape);
}

std::vector<float> distances(std::span<const PlacedCollider> colliders, std::span<const glm::vec3> positions) {
  if (colliders.empty()) return {};
  std::vector<float> values(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 1024), [&](const auto& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      double least = distance(colliders[0], glm::dvec3(positions[v]));
      for (const PlacedCollider& other : colliders.subspan(1))
        least = std::min(least, distance(other, glm::dvec3(positions[v])));
      values[v] = float(least);
    }
  });
  return values;
}

}  // namespace cuticle::sim
