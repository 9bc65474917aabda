#pragma once
// The view of a light, fitted to the vertices of a groom: orthographic from far away, stereographic from a place.
#include <optional>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::shadows {

/// The direction made unit. Error: usage, for zero or not finite.
Result<glm::dvec3> unit_to_light(const glm::dvec3& to_light);

/// Two unit axes that complete the unit `direction` to a right-handed frame (first x second = direction); a smooth
/// function of it but at z = 0.
struct PlaneAxes {
  glm::dvec3 first, second;
};
PlaneAxes plane_axes(const glm::dvec3& direction);

/// A light as shadows see it: far away along `to_light`, not zero; or a point light at `position`, metres, if given.
struct LightSource {
  glm::dvec3 to_light{0, 1, 0};
  std::optional<glm::dvec3> position = {};
};

/// Axes of the light's view, in the precision that CPU and GPU share; `forward` points away from the light.
struct LightAxes {
  glm::vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
  glm::vec3 origin{0};  ///< of light_point
  float reach = 0;      ///< of seen_by_light: 0 for a distant light
};
LightAxes light_axes(const glm::dvec3& unit_to_light);
/// The view of a light on what lies within the bounds: a point light looks at their middle, or down from there. Its
/// depth is the distance in floats, so that a point light 1 km away sees in steps of .06 mm. Error: usage, for a
/// direction that is zero, or a direction or place that is not finite or farther than 1e6 m from the origin.
Result<LightAxes> light_axes(const LightSource& light, const strands::Bounds& bounds);

/// What a method says that takes no point light (LightSource::position).
Error point_light_refused(std::string_view method);

/// A world point, metres, in the light's view (light_frame.glslh).
glm::vec3 view_point(const LightAxes& axes, const glm::vec3& p);

/// The unit direction in which the light passes a world point (light_frame.glslh).
glm::vec3 light_way(const LightAxes& axes, const glm::vec3& p);

/// Extent in the light's view of the positions that it sees, metres (light_frame.glslh); zero for no positions. The GPU
/// finds the same floats (MapGpu_SameGroom_SameIntegers).
struct LightBox {
  glm::vec3 lower{0}, upper{0};
};
LightBox light_box(const LightAxes& axes, std::span<const glm::vec3> positions);

}  // namespace cuticle::shadows
