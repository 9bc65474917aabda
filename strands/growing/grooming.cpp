#include "strands/growing/grooming.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter real(std::string_view name, std::string_view unit, double least, double most,
                         std::string_view initial, std::string_view summary) {
  return {name, ParameterType::real, unit, least, most, initial, {}, summary};
}
constexpr Parameter k_center = {"center", ParameterType::rgb, "m", -2, 2, "0", {}, "Middle of the area, [x, y, z]"};
constexpr Parameter k_radius = real("radius", "m", 0, 1, "0.03", "Applies in full within this distance");
constexpr Parameter k_blend = real("blend", "m", 0, 1, "0.02", "Fades over this distance beyond");

constexpr Parameter k_region[] = {k_center, k_radius, k_blend,
                                  real("density", "1", 0, 4, "1", "Factor on the number of strands"),
                                  real("length", "1", 0.05, 4, "1", "Factor on the length of hair")};
constexpr Parameter k_stroke[] = {
    k_center,
    k_radius,
    k_blend,
    {"direction", ParameterType::rgb, "1", -1, 1, "0/-1/0", {}, "Where the comb pulls, [x, y, z]"},
    real("strength", "1", 0, 1, "1", "How far the stroke replaces what was combed before")};
constexpr Parameter k_bun[] = {
    real("tilt", "rad", -1.5, 1.5, "0.35", "Angle of the tie behind the vertical"),
    real("radius", "m", 0.005, 0.1, "0.026", "From the tie's axis to the middle of the ring"),
    real("thickness", "m", 0.002, 0.1, "0.02", "Radius of the ring's cross-section"),
    real("turns", "1", 0, 4, "0.7", "Round the tie on the way over the ring"),
    real("layers", "1", 0, 0.9, "0.3", "Share of the thickness over which hairs lie above each other")};

Area area_of(const registry::ParameterValues& values) {
  return {values.rgb("center"), values.real("radius"), values.real("blend")};
}

}  // namespace

double Area::weight(const glm::dvec3& point) const {
  const double distance = glm::distance(point, center);
  if (distance <= radius) return 1;
  return blend > 0 ? 1 - glm::smoothstep(radius, radius + blend, distance) : 0;
}

registry::ParameterTable region_parameters() { return k_region; }
registry::ParameterTable stroke_parameters() { return k_stroke; }
registry::ParameterTable bun_parameters() { return k_bun; }

Region region_of(const registry::ParameterValues& values) {
  return {area_of(values), values.real("density"), values.real("length")};
}
Stroke stroke_of(const registry::ParameterValues& values) {
  return {area_of(values), values.rgb("direction"), values.real("strength")};
}
Bun bun_of(const registry::ParameterValues& values) {
  return {values.real("tilt"), values.real("radius"), values.real("thickness"), values.real("turns"),
          values.real("layers")};
}

double density_factor(const Grooming& grooming, const glm::dvec3& point) {
  double factor = 1;
  for (const Region& region : grooming.regions) factor *= glm::mix(1.0, region.density, region.area.weight(point));
  return factor;
}

double length_factor(const Grooming& grooming, const glm::dvec3& point) {
  double factor = 1;
  for (const Region& region : grooming.regions) factor *= glm::mix(1.0, region.length, region.area.weight(point));
  return factor;
}

std::vector<float> density_map(const Grooming& grooming, const Mesh& mesh) {
  std::vector<float> map;
  if (grooming.regions.empty()) return map;
  for (const glm::vec3& position : mesh.positions) map.push_back(float(density_factor(grooming, glm::dvec3(position))));
  return map;
}

glm::dvec3 combed(const Grooming& grooming, const glm::dvec3& point, const glm::dvec3& direction) {
  glm::dvec3 result = direction;
  for (const Stroke& stroke : grooming.strokes)
    result = glm::mix(result, stroke.direction, stroke.strength * stroke.area.weight(point));
  return result;
}

}  // namespace cuticle::strands
