#include "render/lights_gpu.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace cuticle::render {

namespace {

/// The spot of glTF's KHR_lights_punctual: ((cos - cos outer) / (cos inner - cos outer))^2 between the two angles.
glm::vec4 cone_of(const PointLight& point_light, const glm::dmat3& turn) {
  if (point_light.outer_angle >= k_all_around) return {0, 0, 0, 1};
  const double inner = std::cos(point_light.inner_angle), outer = std::cos(point_light.outer_angle);
  const double scale = 1 / std::max(inner - outer, 1e-6);
  return {glm::vec3(scale * (turn * point_light.axis)), float(-outer * scale)};
}

LightRow row_of(const Light& light, const glm::dmat4& transform) {
  const glm::dmat3 turn(transform);
  if (!light.point_light) return {glm::vec4(turn * light.to_light, 0), glm::vec4(light.irradiance, 0), glm::vec4(0)};
  const glm::dvec3 place(transform * glm::dvec4(light.point_light->position, 1));
  return {glm::vec4(place, 1), glm::vec4(light.point_light->intensity, 0), cone_of(*light.point_light, turn)};
}

}  // namespace

LightRows light_rows(const std::vector<Light>& lights, const glm::dmat4& transform) {
  LightRows rows{};
  for (std::size_t k = 0; k < std::min(lights.size(), rows.size()); ++k) rows[k] = row_of(lights[k], transform);
  return rows;
}

shadows::LightSource source_of(const Light& light) {
  shadows::LightSource source{light.to_light};
  if (light.point_light) source.position = light.point_light->position;
  return source;
}

}  // namespace cuticle::render
