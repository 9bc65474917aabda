#pragma once
// Dual scattering (Zinke, Yuksel, Weber and Keyser 2008) with fibres counted along rays, in the place of paths.
#include "bsdf/dual_scattering/dual_scattering.h"
#include "bsdf/dual_scattering/scattered_light.glslh"

namespace cuticle::render::reference {

/// As render/passes/dual_scattering names them; without its corrections.
struct DualScatteringInstead {
  double forward_density = 1, backward_density = 1;  ///< the paper's d_f and d_b
  double direction_spread = 0.4;                     ///< of fibres about a point, radians
};

/// What fibres that a ray from a light met made of it: the products and sums of the paper's equations 5 and 8.
struct FibresPassed {
  int fibres = 0;
  glm::dvec3 sent_on{1}, spread{0};  ///< the share that each sent on; the variance of directions
};

/// Directions at a fibre.
struct FibreAngles {
  double theta_i = 0, theta_o = 0;  ///< inclinations of light and viewer, radians
  double away = 0;                  ///< |phi| / pi: share of the half of the azimuths that lies behind the fibre
};
/// Of unit vectors in the fibre's frame.
FibreAngles angles_between(const glm::dvec3& to_light, const glm::dvec3& to_viewer);

/// Radiance that scattered more than once, per irradiance: light that other fibres sent on; light that came back.
struct MultipleLight {
  glm::dvec3 onward{0}, back{0};
};

/// Safe to use from several threads. Test: dual_scattering_rays_test.cpp.
class DualScattering {
 public:
  /// Errors: those of bsdf::dual_scattering_terms.
  static Result<DualScattering> make(const bsdf::Model& model, const registry::ParameterValues& values,
                                     const DualScatteringInstead& choice);
  /// One more fibre, which the light meets with this sine of its inclination.
  void pass_fibre(double sine, FibresPassed& passed) const;
  /// Where the fibres before the point are known.
  MultipleLight light_after(const FibresPassed& passed, const FibreAngles& angles) const;
  /// Where a share of the light is known to arrive, as shadow methods say it: fibres are then met at random.
  MultipleLight light_after(const glm::dvec3& transmittance, const FibreAngles& angles) const;

 private:
  using Averages = bsdf::dual_scattering::FibreAverages<double>;
  using Scattered = bsdf::dual_scattering::ScatteredLight<double>;
  Averages averages_of(const bsdf::DualScatteringRow& local, const bsdf::DualScatteringRow& path, int channel) const;
  template <class ScatteredOf>
  MultipleLight light(const FibreAngles& angles, const ScatteredOf& scattered_of) const;

  bsdf::DualScatteringTable table_;
  DualScatteringInstead choice_;
};

}  // namespace cuticle::render::reference
