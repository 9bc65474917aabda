#pragma once
// The orthographic view of a directional light, fitted to a groom.
#include <glm/vec3.hpp>

#include <cuticle/core/result.h>
#include <cuticle/strands/groom.h>

namespace cuticle::shadows {

/// Right-handed axes of the light's view and the box in it that holds the bounds' eight corners, metres. Depth z grows away
/// from the light along `forward` = -to_light. The box is square across (side `width`), centred, and never empty: a groom
/// without extent gets a width of 1e-6 m and a depth of 1e-4 of its width.
struct LightFrame {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
  double center_x = 0, center_y = 0, width = 1;
  double near_z = 0, far_z = 1;
};

/// `to_light`: any finite direction but zero, checked by `unit_to_light`; the axes are a smooth function of it except at -z.
/// The farthest corner lies one part in 10,000 of the depth before `far_z`, so that it falls before the last plane.
LightFrame fit_light_frame(const strands::Bounds& bounds, const glm::dvec3& to_light);

/// The direction made unit. Error: usage, for zero or not finite.
Result<glm::dvec3> unit_to_light(const glm::dvec3& to_light);

/// Two unit axes that complete the unit `direction` to a right-handed frame (axes[0] x axes[1] = direction).
struct PlaneAxes {
  glm::dvec3 first, second;
};
PlaneAxes plane_axes(const glm::dvec3& direction);

}  // namespace cuticle::shadows
