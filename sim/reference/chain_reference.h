#pragma once
// The truth of a hanging chain, for tests and studies: rigid links, accelerations with the tensions solved, Runge-Kutta
// of fourth order in double.
#include <vector>

#include <glm/vec3.hpp>

namespace cuticle::sim {

/// A chain below an anchor at rest at the origin: vertex i of `places` ends link i; masses as in sim/exact (half of the
/// adjacent lengths). SI units.
struct ReferenceChain {
  std::vector<glm::dvec3> places, velocities;
  std::vector<double> lengths;
  glm::dvec3 gravity{0};
};

/// Straight from the origin along `direction` (unit), all vertices moving at `velocity`, across the chain.
ReferenceChain make_reference_chain(const std::vector<double>& lengths, const glm::dvec3& direction,
                                    const glm::dvec3& velocity, const glm::dvec3& gravity);

/// Advances by steps * step seconds. At 2e-5 s the places of 32 links of 0.3 m that swing from the horizontal are
/// within 1e-6 of their length after 0.5 s (Reference.HalfTheStep_ChangesNothing).
void advance_reference(ReferenceChain& chain, double step, int steps);

/// Kinetic and potential energy over the chain's mass, m^2/s^2, from places relative to the anchor and velocities.
double energy_of(const std::vector<double>& lengths, const std::vector<glm::dvec3>& places,
                 const std::vector<glm::dvec3>& velocities, const glm::dvec3& gravity);

}  // namespace cuticle::sim
