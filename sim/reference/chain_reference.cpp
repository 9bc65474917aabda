#include "sim/reference/chain_reference.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace cuticle::sim {
namespace {

using Vectors = std::vector<glm::dvec3>;

double inverse_mass(const std::vector<double>& lengths, std::size_t i) {
  return 2 / (lengths[i] + (i + 1 < lengths.size() ? lengths[i + 1] : 0));
}

/// Accelerations with which no link changes its length: for every link, relative acceleration along it = -(relative
/// speed across it)^2 / length; tridiagonal in the tensions.
Vectors accelerations(const ReferenceChain& chain, const Vectors& places, const Vectors& velocities) {
  const std::size_t count = places.size();
  Vectors directions(count + 1, glm::dvec3(0)), result(count);
  std::vector<double> pivot(count), tension(count + 1, 0.0), off(count + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 edge = i ? places[i] - places[i - 1] : places[0],
                     relative = i ? velocities[i] - velocities[i - 1] : velocities[0];
    const double length = glm::length(edge), above = i ? inverse_mass(chain.lengths, i - 1) : 0;
    directions[i] = edge / length;
    const double along = glm::dot(relative, directions[i]);
    tension[i] =
        (glm::dot(relative, relative) - along * along) / length + (i ? 0 : glm::dot(directions[0], chain.gravity));
    pivot[i] = above + inverse_mass(chain.lengths, i);
    if (i == 0) continue;
    off[i] = -above * glm::dot(directions[i], directions[i - 1]);
    const double share = off[i] / pivot[i - 1];
    pivot[i] -= share * off[i];
    tension[i] -= share * tension[i - 1];
  }
  for (std::size_t i = count; i-- > 0;) tension[i] = (tension[i] - off[i + 1] * tension[i + 1]) / pivot[i];
  for (std::size_t i = 0; i < count; ++i)
    result[i] = chain.gravity -
                inverse_mass(chain.lengths, i) * (tension[i] * directions[i] - tension[i + 1] * directions[i + 1]);
  return result;
}

Vectors sum(const Vectors& a, const Vectors& b, double factor) {
  Vectors result = a;
  for (std::size_t i = 0; i < a.size(); ++i) result[i] += b[i] * factor;
  return result;
}

void step_reference(ReferenceChain& chain, double h) {
  const Vectors &x = chain.places, &v = chain.velocities;
  const Vectors a1 = accelerations(chain, x, v);
  const Vectors v2 = sum(v, a1, h / 2), a2 = accelerations(chain, sum(x, v, h / 2), v2);
  const Vectors v3 = sum(v, a2, h / 2), a3 = accelerations(chain, sum(x, v2, h / 2), v3);
  const Vectors v4 = sum(v, a3, h), a4 = accelerations(chain, sum(x, v3, h), v4);
  for (std::size_t i = 0; i < x.size(); ++i) {
    chain.places[i] += (chain.velocities[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]) * (h / 6);
    chain.velocities[i] += (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]) * (h / 6);
  }
}

}  // namespace

ReferenceChain make_reference_chain(const std::vector<double>& lengths, const glm::dvec3& direction,
                                    const glm::dvec3& velocity, const glm::dvec3& gravity) {
  ReferenceChain chain{{}, Vectors(lengths.size(), velocity), lengths, gravity};
  double arc = 0;
  for (double length : lengths) chain.places.push_back(direction * (arc += length));
  return chain;
}

void advance_reference(ReferenceChain& chain, double step, int steps) {
  for (int k = 0; k < steps; ++k) step_reference(chain, step);
}

double energy_of(const std::vector<double>& lengths, const std::vector<glm::dvec3>& places,
                 const std::vector<glm::dvec3>& velocities, const glm::dvec3& gravity) {
  double energy = 0, mass = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double own = 1 / inverse_mass(lengths, i);
    mass += own;
    energy += own * (glm::dot(velocities[i], velocities[i]) / 2 - glm::dot(gravity, places[i]));
  }
  return energy / mass;
}

}  // namespace cuticle::sim
