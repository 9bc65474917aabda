#pragma once
// The dynamics of particles that strands and sheets share: Verlet steps, distances, what is not finite put back.
#include <span>

#include "sim/classic/settings.h"
#include "sim/classic/length_constraint.glslh"
#include "sim/turn.glslh"

namespace cuticle::sim::classic {

/// A strand's, or a sheet's, share of the arrays: RestPose::places and ::traits (x: inverse mass, 0 where the head
/// carries the particle; y: place along the fading pull), positions relative to the head's translation. begin_places:
/// where a skin that deforms had them at the substep's begin; else as places.
struct Particles {
  std::span<const glm::vec4> places, traits;
  std::span<glm::vec3> positions, starts, velocities;
  std::span<const glm::vec4> begin_places = places;

  std::size_t size() const { return places.size(); }
  glm::vec3 target(std::size_t particle, const glm::vec4& rotation) const {
    return turned(glm::vec3(places[particle]), glm::vec3(rotation), rotation.w);
  }
};

/// The Verlet step (N7); carried particles go with the head.
void integrate(const Particles& particles, const StepConstants& step);

/// Corrects the distance of a and b, not both carried, once (N8).
inline void keep_distance(const Particles& p, std::size_t a, std::size_t b, float rest_length,
                          const glm::vec4& rotation) {
  const glm::vec3 edge = p.positions[b] - p.positions[a];
  const glm::vec3 before = direction_of(p.starts[b] - p.starts[a]);
  const glm::vec3 fallback =
      lacks_direction(edge, rest_length) ? direction_of(p.target(b, rotation) - p.target(a, rotation)) : before;
  const glm::vec3 excess = length_excess(edge, rest_length, before, fallback) / (p.traits[a].x + p.traits[b].x);
  p.positions[a] += excess * p.traits[a].x;
  p.positions[b] -= excess * p.traits[b].x;
}

/// Velocities from displacements; true when something was not finite and all particles were put into the rest pose.
bool finish(const Particles& particles, const StepConstants& step);

}  // namespace cuticle::sim::classic
