// Lights as points see them, and what happens at diffuse surfaces.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "render/reference/wave.h"

namespace cuticle::render::reference {

namespace {

constexpr double k_least_distance = 1e-3;  // metres: what lies nearer to a point light is lit as from there

double spot_share(const PointLight& point_light, const glm::dvec3& to_light) {
  if (point_light.outer_angle >= k_all_around) return 1;
  const double inner = std::cos(point_light.inner_angle), outer = std::cos(point_light.outer_angle);
  const double share = std::clamp((glm::dot(-to_light, point_light.axis) - outer) / (inner - outer), 0.0, 1.0);
  return share * share;
}

/// An even direction of the cone around a unit axis.
glm::dvec3 direction_in_cone(const glm::dvec3& axis, double cosine_of_edge, double u0, double u1) {
  const double cosine = 1 - u0 * (1 - cosine_of_edge), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double turn = 2 * std::numbers::pi * u1;
  const glm::dvec3 other = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(axis, other));
  return glm::normalize(cosine * axis + sine * (std::cos(turn) * side + std::sin(turn) * glm::cross(axis, side)));
}

}  // namespace

/// From a point of light to one of the disk that a sphere or a sun shows: a direction drawn evenly in its cone of solid
/// angle 2 pi (1 - c) with radiance E / (pi s^2), c and s the cosine and sine of half its angle.
void Wave::spread(Arriving& from, const Light& light, std::uint32_t k) const {
  const TraceOptions& options = scene_.options;
  const bool is_point_light = light.point_light.has_value();
  const double away = from.distance, radius = options.point_light_radius;
  const double sine = is_point_light ? radius / away : std::sin(options.sun_angle);
  if (!(sine > 0) || !(sine < 1)) return;  // a point; or inside the point light, which is lit as by a point
  const double cosine = std::sqrt(1 - sine * sine);
  const auto u = numbers(k, Purpose::light);
  from.to_light = direction_in_cone(from.to_light, cosine, double(u[1]), double(u[2]));
  from.irradiance *= 2 / (1 + cosine);
  if (!is_point_light) return;
  const double along = glm::dot(light.point_light->position - from.point, from.to_light);
  from.distance = along - std::sqrt(std::max(0.0, radius * radius - away * away + along * along));
}

/// At the scattering that the camera sees every light is asked, further on one that is drawn; the surroundings always.
int Wave::light_rounds() const {
  const int lights = int(scene_.scene->lights.size());
  return (scattering_ == 0 ? lights : std::min(lights, 1)) + int(scene_.draws_surroundings());
}

Wave::Arriving Wave::arriving(const glm::dvec3& point, std::uint32_t k, int round) const {
  const std::vector<Light>& lights = scene_.scene->lights;
  if (scene_.draws_surroundings() && round == light_rounds() - 1) {
    const auto u = numbers(k, Purpose::surroundings);
    const SurroundingsLight::Drawn drawn = scene_.surroundings->draw(double(u[0]), double(u[1]), double(u[2]));
    return {.to_light = drawn.to_light, .irradiance = drawn.radiance / drawn.density, .density = drawn.density};
  }
  const bool draws = scattering_ > 0 && lights.size() > 1;
  const double u = draws ? double(numbers(k, Purpose::light)[0]) : 0;
  const std::size_t at = draws ? std::size_t(u * double(lights.size())) : std::size_t(round);
  const Light& light = lights[at];
  Arriving from{
      .to_light = light.to_light, .irradiance = (draws ? double(lights.size()) : 1) * light.irradiance, .light = at};
  from.point = point;
  if (!light.point_light) {
    spread(from, light, k);
    return from;
  }
  const glm::dvec3 way = light.point_light->position - point;
  from.distance = glm::length(way);
  from.to_light = from.distance > 0 ? way / from.distance : glm::dvec3(0, 1, 0);
  const double away = std::max(from.distance, k_least_distance);
  from.irradiance = (draws ? double(lights.size()) : 1) * light.point_light->intensity *
                    (spot_share(*light.point_light, from.to_light) / (away * away));
  spread(from, light, k);
  return from;
}

/// Lambert: albedo / pi times the light on the surface.
void Wave::light_surface(const SurfacePoint& point, int round) {
  const Arriving from = arriving(point.position, point.path, round);
  const double cosine = glm::dot(point.normal, from.to_light);
  if (!(cosine > 0)) return;
  const Path& path = paths_[point.path];
  glm::dvec3 light = path.throughput * point.albedo * from.irradiance * (cosine / std::numbers::pi);
  if (from.density > 0) light *= from.density / (from.density + cosine / std::numbers::pi);
  if (!(std::max({light.x, light.y, light.z}) > 0)) return;
  if (scene_.rays->is_blocked(point.position, from.to_light, from.distance, {}, path.time)) return;
  const int backward = path.backward + int(scattering_ > 0);
  add(point.path, light, {scattering_ + 1, backward, scattering_ > 0 ? shares_of(point.path) : nullptr});
}

void Wave::scatter_surface(const SurfacePoint& point) {
  Path& path = paths_[point.path];
  const auto u = numbers(point.path, Purpose::direction);
  if (!goes_on(point.path, path.throughput * point.albedo, double(u[2]))) return;
  const glm::dvec2 disk = point_of_disk(double(u[0]), double(u[1]));
  const double cosine = std::sqrt(std::max(1e-12, 1 - glm::dot(disk, disk)));
  const glm::dvec3 other = std::abs(point.normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(point.normal, other));
  path.origin = point.position;
  path.direction = glm::normalize(disk.x * side + disk.y * glm::cross(point.normal, side) + cosine * point.normal);
  path.from = {};
  path.density = cosine / std::numbers::pi;
  path.backward += int(scattering_ > 0);
}

}  // namespace cuticle::render::reference
