#pragma once
// The orthographic view of a directional light, fitted to the vertices of a groom.
#include <span>

#include <glm/vec3.hpp>

#include <cuticle/core/result.h>

namespace cuticle::shadows {

/// The direction made unit. Error: usage, for zero or not finite.
Result<glm::dvec3> unit_to_light(const glm::dvec3& to_light);

/// Two unit axes that complete the unit `direction` to a right-handed frame (first x second = direction); a smooth function of
/// it but at z = 0.
struct PlaneAxes {
  glm::dvec3 first, second;
};
PlaneAxes plane_axes(const glm::dvec3& direction);

/// Axes of the light's view, in the precision that CPU and GPU share; `forward` points away from the light.
struct LightAxes {
  glm::vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
};
LightAxes light_axes(const glm::dvec3& unit_to_light);

/// Extent along the light's axes, metres (light_frame.glslh); zero for no positions. The GPU finds the same floats
/// (MapGpu_SameGroom_SameIntegers).
struct LightBox {
  glm::vec3 lower{0}, upper{0};
};
LightBox light_box(const LightAxes& axes, std::span<const glm::vec3> positions);

}  // namespace cuticle::shadows
