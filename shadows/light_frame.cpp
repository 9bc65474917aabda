#include "shadows/light_frame.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shadows/light_frame.glslh"

namespace cuticle::shadows {

Result<glm::dvec3> unit_to_light(const glm::dvec3& to_light) {
  const double length = glm::length(to_light);
  if (!std::isfinite(length) || length < 1e-12)
    return usage_error(
        fmt::format("light: direction ({}, {}, {}) must be finite and not zero", to_light.x, to_light.y, to_light.z),
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

namespace {

/// Unit, from the middle of what is lit to the point light; up where they are at one place.
glm::dvec3 direction_of(const glm::dvec3& from_middle) {
  const double distance = glm::length(from_middle);
  return distance > 1e-9 ? from_middle / distance : glm::dvec3(0, 1, 0);
}

}  // namespace

Result<LightAxes> light_axes(const LightSource& light, const strands::Bounds& bounds) {
  if (!light.position) {
    CUTICLE_ASSIGN(const glm::dvec3 to_light, unit_to_light(light.to_light));
    return light_axes(to_light);
  }
  const glm::dvec3 place = *light.position, lower(bounds.lower), upper(bounds.upper);
  if (!(glm::length(place) <= 1e6))
    return usage_error(
        fmt::format("light: place ({}, {}, {}) m must be within 1e6 m of the origin", place.x, place.y, place.z));
  const glm::dvec3 from_middle = place - 0.5 * (lower + upper);
  LightAxes axes = light_axes(direction_of(from_middle));
  axes.origin = glm::vec3(-glm::dot(glm::dvec3(axes.right), place), -glm::dot(glm::dvec3(axes.up), place),
                          -glm::dot(glm::dvec3(axes.forward), place));
  const double distance = std::max(glm::length(from_middle), 0.5 * glm::length(upper - lower));
  axes.reach = float(2 * std::max(distance, double(k_least_point_light_distance)));
  return axes;
}

Error point_light_refused(std::string_view method) {
  return usage_error(fmt::format("{}: a light with a place; this method takes distant lights", method),
                     "a method of the light's view: deep_opacity, shadow_map");
}

glm::vec3 view_point(const LightAxes& axes, const glm::vec3& p) {
  return seen_by_light(light_point(axes.right, axes.up, axes.forward, axes.origin, p), axes.reach);
}

glm::vec3 light_way(const LightAxes& axes, const glm::vec3& p) {
  return light_way<float>(axes.right, axes.up, axes.forward, axes.origin, p, axes.reach);
}

LightBox light_box(const LightAxes& axes, std::span<const glm::vec3> positions) {
  if (positions.empty()) return {};
  constexpr float k_far = 3e38f;  // as map_fit.comp begins
  LightBox box{glm::vec3(k_far), glm::vec3(-k_far)};
  for (const glm::vec3& position : positions) {
    const glm::vec3 point = view_point(axes, position);
    if (!is_seen_by_light(point, axes.reach)) continue;
    box.lower = glm::min(box.lower, point);
    box.upper = glm::max(box.upper, point);
  }
  return box;
}

}  // namespace cuticle::shadows
