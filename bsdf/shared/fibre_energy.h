#pragma once
// Where a smooth fibre sends its light at normal incidence: what models without physics are given when they stand for a
// fibre.
#include "bsdf/fibre.h"
#include "bsdf/shared/quadrature.glslh"
#include "bsdf/shared/refraction.glslh"

namespace cuticle::bsdf {

/// Shares of the light, over all offsets h: reflected by the surface (R), once inside (TRT), and all that leaves after
/// at least one crossing (TT, TRT and every later path).
struct FibreEnergy {
  double reflected = 0;
  glm::dvec3 once_inside{0}, crossed{0};
};

/// Half the integrals of A(p, h) over h at theta_d = 0 (Marschner et al. 2003; later paths by their geometric series).
/// Within 1e-6.
inline FibreEnergy fibre_energy(const Fibre& fibre) {
  const Dielectric<double> dielectric{fibre.eta * fibre.eta, (fibre.eta - 1) * (fibre.eta + 1), fibre.sigma_a};
  const Refraction<double> r = make_refraction<double>(dielectric, 0, 1);
  constexpr double quarter = 1.57079632679489661923;
  FibreEnergy energy;
  for (int k = 0; k < 64; ++k) {
    const glm::dvec2 node = smooth_midpoint<double>(k, 64);
    const double gamma = quarter * node.x, c = precise_cos(gamma), weight = c * node.y * quarter;
    const double cos_t = cos_refracted(r, precise_sin(gamma));
    const glm::dvec2 f = fresnel(r, c, cos_t);
    const glm::dvec3 crossing = crossing_transmittance(r, cos_t), tt = crossing * (f.y * f.y);
    energy.reflected += f.x * weight;
    energy.once_inside += tt * crossing * (f.x * weight);
    energy.crossed += tt / (1.0 - crossing * f.x) * weight;
  }
  return energy;
}

}  // namespace cuticle::bsdf
