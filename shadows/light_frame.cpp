#include <cuticle/shadows/light_frame.h>

#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cuticle/shadows/light_frame.glslh>

namespace cuticle::shadows {

Result<glm::dvec3> unit_to_light(const glm::dvec3& to_light) {
  const double length = glm::length(to_light);
  if (!std::isfinite(length) || length < 1e-12)
    return usage_error(fmt::format("light: direction ({}, {}, {}) must be finite and not zero", to_light.x, to_light.y, to_light.z),
                       "give a direction from the scene to the light, for example 1,1,0.3");
  return to_light / length;
}

// The branchless frame of Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
PlaneAxes plane_axes(const glm::dvec3& direction) {
  const double sign = std::copysign(1.0, direction.z);
  const double a = -1.0 / (sign + direction.z);
  const double b = direction.x * direction.y * a;
  return {{1 + sign * direction.x * direction.x * a, sign * b, -sign * direction.x},
          {b, sign + direction.y * direction.y * a, -direction.y}};
}

LightAxes light_axes(const glm::dvec3& unit_to_light) {
  const PlaneAxes axes = plane_axes(-unit_to_light);
  return {glm::vec3(axes.first), glm::vec3(axes.second), glm::vec3(-unit_to_light)};
}

LightBox light_box(const LightAxes& axes, std::span<const glm::vec3> positions) {
  if (positions.empty()) return {};
  const glm::vec3 first = light_point(axes.right, axes.up, axes.forward, positions.front());
  LightBox box{first, first};
  for (const glm::vec3& position : positions) {
    const glm::vec3 point = light_point(axes.right, axes.up, axes.forward, position);
    box.lower = glm::min(box.lower, point);
    box.upper = glm::max(box.upper, point);
  }
  return box;
}

}  // namespace cuticle::shadows
