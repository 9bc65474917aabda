#pragma once
// H18: what a groomer does to hair that grows: regions with settings of their own, comb strokes, a bun. Places are in
// metres in the head's rest space.
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/registry/members.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// Where something applies: 1 within `radius` of `center`, 0 past `radius` + `blend`, smooth between.
struct Area {
  glm::dvec3 center{0};
  double radius = 0.03, blend = 0.02;
  double weight(const glm::dvec3& point) const;
};
/// Factors on density and length within an area.
struct Region {
  Area area;
  double density = 1, length = 1;
};
/// A stroke: within the area hair is combed to `direction`.
struct Stroke {
  Area area;
  glm::dvec3 direction{0, -1, 0};
  double strength = 1;
};
/// Hair drawn together to a tie and laid round it: a ring of hair.
struct Bun {
  double tilt = 0.35;       ///< of the tie behind the vertical, radians
  double radius = 0.026;    ///< from the tie's axis to the middle of the ring, metres
  double thickness = 0.02;  ///< of the ring: radius of its cross-section, metres
  double turns = 0.7;       ///< round the tie on the way over the ring
  double layers = 0.3;      ///< share of the thickness over which hairs lie above each other
};
struct Grooming {
  std::vector<Region> regions;
  std::vector<Stroke> strokes;
  std::optional<Bun> bun;
};

void describe(registry::Members& members, Region& region);
void describe(registry::Members& members, Stroke& stroke);
void describe(registry::Members& members, Bun& bun);

/// Products of the regions' factors at a point; 1 outside all.
double density_factor(const Grooming& grooming, const glm::dvec3& point);
double length_factor(const Grooming& grooming, const glm::dvec3& point);
/// The density factor at every vertex: a map for place_roots.
std::vector<float> density_map(const Grooming& grooming, const Mesh& mesh);
/// `direction` as the strokes leave it, in their order; not of unit length.
glm::dvec3 combed(const Grooming& grooming, const glm::dvec3& point, const glm::dvec3& direction);

}  // namespace cuticle::strands
