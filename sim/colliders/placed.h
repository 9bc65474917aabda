#pragma once
// Colliders as they stand at one moment in the world: for what is measured and drawn, not for the solvers.
#include <span>
#include <variant>
#include <vector>

#include "sim/colliders/distance_field.h"
#include "sim/solver.h"

namespace cuticle::sim {

/// `shape` in a frame of its own, `place` of that frame in the world.
struct PlacedCollider {
  std::variant<Sphere, RoundedBox, FieldPointer> shape;
  Placement place;
};
/// All colliders of a frame at its end: spheres, boxes, fields, then those that move by themselves. On a skin no head
/// carries them.
std::vector<PlacedCollider> placed_colliders(const FrameInput& input);

/// Signed distance from the surface to a place in the world, metres, negative inside. Of a distance field by trilinear
/// interpolation, beyond its grid with the way there added: at most that much too large.
double distance(const PlacedCollider& collider, const glm::dvec3& place);

/// The least distance of each vertex; without colliders none.
std::vector<float> distances(std::span<const PlacedCollider> colliders, std::span<const glm::vec3> positions);

}  // namespace cuticle::sim
