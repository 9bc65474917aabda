#pragma once
// Light walked through a rough dielectric fibre: facets on tilted cuticle scales, circular or elliptical cross-section,
// and a medulla that scatters. The truth for models of such fibres; shares no formula with bsdf and may not include it.
//
// Walks start at the viewer and end toward the light. The energy that ends per steradian of directions toward the light
// is S(theta_i, theta_o, phi) of docs/conventions.md, and all of it together the albedo.
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "study/oracle/microsurface.h"

namespace cuticle::study::oracle {

/// A core of the same refractive index, its cross-section that of the fibre times `ratio`. Coefficients per fibre
/// radius.
struct Medulla {
  double ratio = 0;          ///< 0 .. 1; 0: none
  double scattering = 0;     ///< events per radius
  glm::dvec3 absorption{0};  ///< replaces the fibre's sigma_a inside the medulla
  double anisotropy = 0;     ///< mean cosine of Henyey and Greenstein's phase function, (-1, 1)
};

/// A fibre along z, from root to tip, with semi-axes 1 (along x) and `aspect` (along y). "Per radius" is per semi-major
/// axis.
struct RoughFibre {
  double eta = 1.55;        ///< refractive index, > 1
  glm::dvec3 sigma_a{0.2};  ///< absorption per radius, along the true path
  Microsurface surface;
  double tilt =
      0;  ///< of the facets' mean normal toward the root [rad]: light is mirrored to theta_i + theta_o = -2 tilt
  double aspect = 1;                ///< (0, 1]
  Blocked blocked = Blocked::lost;  ///< `followed`: what a tilted scale would stop meets the untilted surface
  Medulla medulla;
};

/// Where walks start: theta_o in (-pi/2, pi/2), the azimuth phi_o from the major axis, and the offset across the fibre
/// as a share h of its half-width seen from there, positive toward larger azimuths; without h, offsets are spread
/// evenly.
struct Viewer {
  double theta_o = 0, phi_o = 0;
  std::optional<double> h;
};

/// The end of one walk: the direction toward the light, phi = phi_o - phi_i in [-pi, pi], what is left of energy 1, and
/// how often the inside was crossed from surface to surface (0: R, 1: TT, 2: TRT, ...).
struct Departure {
  double theta_i = 0, phi = 0;
  glm::dvec3 energy{0};
  int order = 0;
};

/// One walk; it ends with energy 0 where its light is lost, or after `crossings` crossings.
Departure walk(const RoughFibre& fibre, const Viewer& viewer, int crossings, RandomStream& random);

/// Equal bins of theta_i over [-pi/2, pi/2] and of phi over [-pi, pi].
struct DirectionBins {
  int thetas = 45, phis = 90;
};

struct Estimate {
  glm::dvec3 mean{0}, standard_error{0};
};

/// What walks of each order carry: bin [theta * phis + phi] of `density` is the mean of S over the bin's solid angle
/// [1/sr].
struct OrderScattering {
  Estimate energy;
  std::vector<Estimate> density;
};

/// Walk n draws from stream n of `seed`, so results are the same on every machine. One entry per order, 0 .. orders
/// - 1.
std::vector<OrderScattering> scattering_of(const RoughFibre& fibre, const Viewer& viewer, const DirectionBins& bins,
                                           int orders, std::int64_t walks, std::uint64_t seed);

}  // namespace cuticle::study::oracle
