#pragma once
// What becomes of light that the medulla scattered.
#include <glm/vec3.hpp>

namespace cuticle::bsdf::yan_fur {

/// A fibre and its medulla; coefficients per fibre radius, `kappa` the medulla's radius over the fibre's.
struct LayeredFibre {
  double eta = 1.55, layers = 1;
  glm::dvec3 sigma_a{0};
  double kappa = 0, sigma_ms = 0, sigma_ma = 0;
  bool operator==(const LayeredFibre&) const = default;
};

/// The share of light, from its first scattering on, that comes out at last, for red, green and blue: 1 where nothing
/// absorbs. Within 4e-5 of mpmath relative (yan_fur_test); against walks: README.md. Where sigma_ms or kappa is 0
/// nothing is scattered, and it is some finite number. Remembers the last fibre of each thread: 0.1 ms for another one.
glm::dvec3 share_let_out(const LayeredFibre& fibre);

}  // namespace cuticle::bsdf::yan_fur
