#pragma once
// Integrals over the sphere of incident directions of functions with lobes as narrow as a thousandth of a radian.
#include <vector>

#include "study/model_check/subject.h"

namespace cuticle::study::model_check {

/// A direction near which the integrand is large, and how far it stays so [rad].
struct Seed {
  double theta = 0, phi = 0, theta_scale = 1, phi_scale = 1;
};
/// A scale from which on a lobe is taken to reach cells in which none of its seeds lies [rad].
constexpr double wide_lobe = 0.7;
/// How the sphere is divided to begin with: by values of theta_i and of phi, rising, and then around seeds.
struct Partition {
  std::vector<double> theta, phi;
  std::vector<Seed> seeds = {};
  double scales = 6;  ///< how many times wider than its seeds' own scale a cell may be to begin with
  bool even = false;  ///< the integrand is the same at -phi: phi covers 0 .. pi, and counts twice
};

/// A part of the sphere, its integral, an estimate of its error, and what the integrand says of its own.
struct Cell {
  double theta_low = 0, theta_high = 0, phi_low = 0, phi_high = 0;
  glm::dvec3 value{0};
  double error = 0, own_error = 0;
  bool along_phi = false;  ///< where it is resolved worst, and divided next
};
struct SphereIntegral {
  glm::dvec3 value{0};
  double error = 0;      ///< estimated absolute error of the mean of the channels
  double own_error = 0;  ///< what errors of the integrand itself add at most, in the largest channel
  std::size_t evaluations = 0;
  bool converged = false;
  std::vector<Cell> cells;
};
struct SphereTolerance {
  double absolute = 1e-4;
  std::size_t evaluations = 400000;
  Batch own_error = {};           ///< of the integrand; cells are not divided below it
  double most_own_error = 1e300;  ///< where it adds up to more over the first cells, nothing is integrated
};

/// The integral over theta_i and phi of `integrand` cos(theta_i), by cells of Gauss-Legendre points that are halved
/// along the direction in which their Legendre coefficients fall slowest until the errors sum to the tolerance. `view`
/// gives theta_o, h and phi_o. Within 2e-4 of 1 for a fibre with lobes of 1e-3 rad up to grazing, 1e-8 elsewhere
/// (model_check_test.cpp).
SphereIntegral integrate_sphere(const Batch& integrand, const bsdf::Point& view, const Partition& partition,
                                const SphereTolerance& tolerance = {});

/// An even division of the sphere, with the scatterer's own samples and the widths of its lobes as seeds, or directions
/// at all distances from the mirror direction where it has no sampler; half of it where S and density are even in phi.
Partition partition_for(const Scatterer& scatterer, const bsdf::Point& view);

/// The energy that is scattered for one view: the integral of S cos(theta_i); tolerances as SphereTolerance.
SphereIntegral scattered_energy(const Scatterer& scatterer, const bsdf::Point& view, double absolute = 1e-4,
                                double most_own_error = 1e300);

}  // namespace cuticle::study::model_check
