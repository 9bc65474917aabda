#pragma once
// Sphere colliders with pearls: settings, the spheres of a frame, and the CPU twin of the kernel.
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cuticle/sim/solver.h>

namespace cuticle::sim::colliders {

struct ContactSettings {
  float pearl_radius = 0;  ///< metres, of the sphere on every particle
  bool fit_pearls = true;  ///< grow each pearl until its straight segments clear the sphere
  float friction = 0;      ///< Coulomb's coefficient
};
ContactSettings make_contact_settings(const registry::ParameterValues& values);

/// xyz: centre in the head's rest space; w: radius; metres.
std::vector<glm::vec4> packed(std::span<const Sphere> spheres);

/// One strand at one end of a substep. Spans hold one entry per vertex.
struct Contact {
  std::span<const glm::vec4> traits;  ///< RestPose::traits
  std::span<glm::vec3> places;        ///< relative to the head's translation
  std::size_t anchor = 0;             ///< last vertex that the head carries
  glm::vec4 rotation{0, 0, 0, 1};     ///< of the head, at that end
  glm::vec3 fallback{0, 1, 0};        ///< unit: where a vertex at a sphere's very centre leaves to
};
/// Pushes the free vertices out of every sphere in turn.
void push_out(const Contact& contact, std::span<const glm::vec4> spheres, const ContactSettings& settings);

}  // namespace cuticle::sim::colliders
