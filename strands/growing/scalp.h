#pragma once
// The scalp: the part of a head's skin that carries hair, as a disc of rings about the crown.
#include <functional>

#include <glm/vec3.hpp>

#include "strands/mesh.h"

namespace cuticle::strands {

/// From where the scalp's directions are measured: the middle of the skull, metres.
inline constexpr glm::dvec3 k_skull_center{0, 0.14, -0.01};

struct SkinPoint {
  glm::dvec3 position, normal;
};
/// The skin along a unit direction from `k_skull_center`.
using SkinAlong = std::function<SkinPoint(const glm::dvec3& direction)>;

/// About `vertices` points up to the hairline, the same directions on every head. It is cut along the parting, so that
/// hair on both sides of it can be combed apart. Texture coordinates: 0.5 at the crown, a circle of radius 0.5 at the
/// hairline.
Mesh make_scalp(int vertices, const SkinAlong& skin);

}  // namespace cuticle::strands
