#pragma once
// Sphere colliders with pearls: settings, the spheres of a frame, and the CPU twin of the kernel.
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "sim/solver.h"

namespace cuticle::sim::colliders {

struct ContactSettings {
  static constexpr std::string_view name = "colliders";
  float pearl_radius = 0.001f;
  bool fit_pearls = true;
  float friction = 0;
};
void describe(registry::Members& members, ContactSettings& contact);

/// xyz: centre in the head's rest space; w: radius; metres.
std::vector<glm::vec4> packed(std::span<const Sphere> spheres);

/// Spheres of a frame. Where none moves by itself, the same in every substep; otherwise first those at a substep's
/// begin, then those at its end, of one substep after the other: all in the rest space of the head as it stands then.
struct SubstepSpheres {
  std::vector<glm::vec4> spheres;  ///< as packed
  std::size_t count = 0;           ///< at a time
  bool move = false;
  std::span<const glm::vec4> at_begin(std::size_t substep) const { return at(2 * substep); }
  std::span<const glm::vec4> at_end(std::size_t substep) const { return at(2 * substep + 1); }

 private:
  std::span<const glm::vec4> at(std::size_t time) const {
    return std::span(spheres).subspan(move ? time * count : 0, count);
  }
};
/// Of FrameInput::moving the spheres, after FrameInput::colliders.
SubstepSpheres packed(const FrameInput& input, std::size_t substeps);

/// One strand at one end of a substep. Spans hold one entry per vertex.
struct Contact {
  std::span<const glm::vec4> traits;  ///< RestPose::traits
  std::span<glm::vec3> places;        ///< relative to the head's translation
  std::size_t anchor = 0;             ///< last vertex that the head carries
  glm::vec4 rotation{0, 0, 0, 1};     ///< of the head, at that end
  glm::vec3 fallback{0, 1, 0};        ///< unit: where a vertex at a sphere's very centre leaves to
};
/// Whether any free vertex is in a sphere, so that push_out would move it.
bool touches(const Contact& contact, std::span<const glm::vec4> spheres, const ContactSettings& settings);
/// Pushes the free vertices out of every sphere in turn.
void push_out(const Contact& contact, std::span<const glm::vec4> spheres, const ContactSettings& settings);

}  // namespace cuticle::sim::colliders
