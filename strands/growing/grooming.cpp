#include "strands/growing/grooming.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

void describe(registry::Members& members, Area& area) {
  members(area.center, "center", "m", -2, 2, "Middle of the area, [x, y, z]");
  members(area.radius, "radius", "m", 0, 1, "Applies in full within this distance");
  members(area.blend, "blend", "m", 0, 1, "Fades over this distance beyond");
}

}  // namespace

double Area::weight(const glm::dvec3& point) const {
  const double distance = glm::distance(point, center);
  if (distance <= radius) return 1;
  return blend > 0 ? 1 - glm::smoothstep(radius, radius + blend, distance) : 0;
}

void describe(registry::Members& members, Region& region) {
  describe(members, region.area);
  members(region.density, "density", "1", 0, 4, "Factor on the number of strands");
  members(region.length, "length", "1", 0.05, 4, "Factor on the length of hair");
}

void describe(registry::Members& members, Stroke& stroke) {
  describe(members, stroke.area);
  members(stroke.direction, "direction", "1", -1, 1, "Where the comb pulls, [x, y, z]");
  members(stroke.strength, "strength", "1", 0, 1, "How far the stroke replaces what was combed before");
}

void describe(registry::Members& members, Bun& bun) {
  members(bun.tilt, "tilt", "rad", -1.5, 1.5, "Angle of the tie behind the vertical");
  members(bun.radius, "radius", "m", 0.005, 0.1, "From the tie's axis to the middle of the ring");
  members(bun.thickness, "thickness", "m", 0.002, 0.1, "Radius of the ring's cross-section");
  members(bun.turns, "turns", "1", 0, 4, "Round the tie on the way over the ring");
  members(bun.layers, "layers", "1", 0, 0.9, "Share of the thickness over which hairs lie above each other");
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
