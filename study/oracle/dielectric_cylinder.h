#pragma once
// Light walked through a smooth dielectric circular cylinder by ray optics with vectors in three dimensions: the truth
// that fibre models are tested against. Shares no formula with bsdf and may not include it.
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace cuticle::study::oracle {

/// A cylinder of radius 1 along z.
struct DielectricCylinder {
  double eta = 1.55;        ///< refractive index, > 1
  glm::dvec3 sigma_a{0.2};  ///< absorption per radius, along the true path
};

/// What leaves the cylinder by a path of one order: 0 is R, reflected outside; 1 is TT; 2 is TRT, reflected inside
/// once; ...
struct Exit {
  double phi = 0;        ///< azimuth of the outgoing direction about z from the direction toward the light [rad]
  double sin_theta = 0;  ///< its inclination, as a sine
  glm::dvec3 energy{0};  ///< share of the ray's energy; light counts as unpolarised at every interface
};

/// One ray at inclination theta [rad, (-pi/2, pi/2)] and offset h in (-1, 1), followed to its exit of the order given.
Exit follow(const DielectricCylinder& cylinder, double theta, double h, int lobe);

/// Means of N over `bins` equal bins of phi from -pi to pi [1/rad]: the energy of `offsets` narrow beams that fill the
/// cylinder's width, each spread evenly over the azimuths between its two edges. A whole lobe sums to half the integral
/// of A over h. The error falls with the square of 1/offsets, except in a bin that holds a caustic.
std::vector<glm::dvec3> azimuthal_bins(const DielectricCylinder& cylinder, double theta_d, int lobe, int bins,
                                       int offsets);

/// Half the integral over h of the energy that leaves with this order.
glm::dvec3 lobe_energy(const DielectricCylinder& cylinder, double theta_d, int lobe, int offsets);

/// Energy per order, estimated with random offsets and random choices between reflection and refraction.
struct MonteCarloEnergy {
  std::vector<glm::dvec3> mean, standard_error;  ///< per order, 0 .. orders - 1
};
MonteCarloEnergy random_walks(const DielectricCylinder& cylinder, double theta_d, int orders, std::int64_t walks,
                              std::uint64_t seed);

}  // namespace cuticle::study::oracle
