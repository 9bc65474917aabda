#pragma once
// Plain structs that several modules see: camera, lights, floor, sphere collider.
#include <numbers>
#include <optional>
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
  double vertical_field_of_view = 0.5;        ///< radians, 0.01 .. 3
  double near_plane = 0.01, far_plane = 100;  ///< metres
  glm::ivec2 resolution{640, 640};
  glm::dvec2 pixel_shift{0};  ///< by which the picture lies to the right of and below where it would, pixels

  bool operator==(const Camera&) const = default;
};
/// World to view (camera looks along -z).
glm::dmat4 view_matrix(const Camera& camera);
/// View to clip: x right, y down, depth 0 (near) .. 1 (far), as Vulkan has it.
glm::dmat4 projection_matrix(const Camera& camera);

/// Half the angle of a point light's cone, radians, from which on it shines all around.
inline constexpr double k_all_around = std::numbers::pi;

/// A light with a place. Irradiance on a plane facing it is intensity / distance^2, within 1 mm as at 1 mm. `axis`,
/// unit, is where a spot shines: in full up to `inner_angle` from it, not at all from `outer_angle` on, between them by
/// the square of a ramp of the angle's cosine (glTF KHR_lights_punctual).
struct PointLight {
  glm::dvec3 position{0};   ///< metres
  glm::dvec3 intensity{1};  ///< irradiance at 1 m: power per solid angle, linear Rec.709
  glm::dvec3 axis{0, -1, 0};
  double inner_angle = 0, outer_angle = k_all_around;  ///< radians
};

/// A light: far away, radiance times solid angle from the unit direction `to_light` from the scene; or a point light.
struct Light {
  std::string name;
  glm::dvec3 to_light{0, 1, 0};
  glm::dvec3 irradiance{1};  ///< on a plane facing the light, linear Rec.709
  std::optional<PointLight> point_light = {};
};
/// Lights of a scene, those of its environment with them.
inline constexpr std::size_t k_max_lights = 8;

/// A square that lies level, its middle above or below the origin.
struct Floor {
  double height = 0, size = 2;  ///< metres
  glm::dvec3 albedo{0.4};
};

/// A sphere collider that moves with a frame (a joint of the skeleton) or stands still.
struct Sphere {
  glm::dvec3 center{0};
  double radius = 0;
};

}  // namespace cuticle
