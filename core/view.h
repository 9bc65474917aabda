#pragma once
// Plain structs that several modules see: camera, light, sphere collider, image size.
#include <string>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cuticle {

/// A pinhole camera; metres and radians, right-handed world, y up.
struct Camera {
  glm::dvec3 position{0, 0, 1};
  glm::dvec3 target{0};
  glm::dvec3 up{0, 1, 0};
  double vertical_field_of_view = 0.5;  ///< radians, 0.01 .. 3
  double near_plane = 0.01, far_plane = 100;  ///< metres
  glm::ivec2 resolution{640, 640};

  bool operator==(const Camera&) const = default;
};
/// World to view (camera looks along -z).
glm::dmat4 view_matrix(const Camera& camera);
/// View to clip: x right, y down, depth 0 (near) .. 1 (far), as Vulkan has it.
glm::dmat4 projection_matrix(const Camera& camera);

/// A directional light: `to_light` is the unit direction from the scene to the light; radiance times solid angle.
struct Light {
  std::string name;
  glm::dvec3 to_light{0, 1, 0};
  glm::dvec3 irradiance{1};  ///< on a plane facing the light, linear Rec.709
};

/// A sphere collider that moves with a frame (a joint of the skeleton) or stands still.
struct Sphere {
  glm::dvec3 center{0};
  double radius = 0;
};

}  // namespace cuticle
