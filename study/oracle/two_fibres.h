#pragma once
// Light between two parallel fibres by a walk of its own, in the plane across them: what the path tracer of
// render/reference is tested against. Shares no code with it, nor with bsdf.
#include <cstdint>

namespace cuticle::study::oracle {

/// Two cylinders of one radius along x, without ends; the second's axis lies at y = distance. Both scatter
/// S = coefficient cos(theta_i), an albedo of pi^2 times the coefficient, whatever the azimuth (Kajiya and Kay's
/// diffuse part). Light leaves a cylinder where the viewer's ray came in, and passes through that cylinder.
struct TwoFibres {
  double radius = 1, distance = 3;
  double coefficient = 0.09;
};

/// A distant light of irradiance 1: its inclination and its azimuth from y to z, radians.
struct OracleLight {
  double theta = 0, phi = 0;
};

struct SeenRadiance {
  double mean = 0, standard_error = 0;
};

/// Mean radiance over the widths of both fibres, seen from afar along z; of paths of at most `scatterings` (0: all).
SeenRadiance seen_radiance(const TwoFibres& fibres, const OracleLight& light, int scatterings, std::int64_t walks,
                           std::uint64_t seed);

}  // namespace cuticle::study::oracle
