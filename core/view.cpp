#include "core/view.h"

#include <cmath>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "core/expect.h"

namespace cuticle {
namespace {

/// An up vector that is not parallel to the line of sight.
glm::dvec3 usable_up(const Camera& camera) {
  const glm::dvec3 forward = camera.target - camera.position;
  const double sine = glm::length(glm::cross(forward, camera.up));
  if (sine > 1e-9 * glm::length(forward) * glm::length(camera.up)) return camera.up;
  const bool along_z = std::abs(forward.z) > std::abs(forward.x) && std::abs(forward.z) > std::abs(forward.y);
  return along_z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
}

}  // namespace

glm::dmat4 view_matrix(const Camera& camera) {
  CUTICLE_EXPECT(camera.position != camera.target, "the camera looks at a point other than its own");
  return glm::lookAtRH(camera.position, camera.target, usable_up(camera));
}

glm::dmat4 projection_matrix(const Camera& camera) {
  CUTICLE_EXPECT(camera.resolution.x > 0 && camera.resolution.y > 0, "a camera has pixels");
  const double aspect = double(camera.resolution.x) / double(camera.resolution.y);
  glm::dmat4 projection = glm::perspectiveRH_ZO(camera.vertical_field_of_view, aspect, camera.near_plane, camera.far_plane);
  projection[1][1] = -projection[1][1];
  const glm::dvec2 shift = 2.0 * camera.pixel_shift / glm::dvec2(camera.resolution);  // w is -z
  projection[2][0] -= shift.x;
  projection[2][1] -= shift.y;
  return projection;
}

}  // namespace cuticle
