#pragma once
// A fibre as a microscope would describe it, so that models can be compared on the same hair. Every model maps it onto its own
// parameters in its own folder.
#include <string>

#include <glm/vec3.hpp>

namespace cuticle::bsdf {

struct Fibre {
  glm::dvec3 sigma_a{0.2};              ///< absorption of the cortex per fibre radius
  double eta = 1.55;                    ///< refractive index
  double radius = 35e-6;                ///< [m]
  double scale_tilt = 0.05235987755982988;  ///< of the cuticle's scales against the axis [rad], positive; they lean to the tip
  double longitudinal_deviation = 0.2;  ///< standard deviation of the R lobe in theta_i [rad]
  double azimuthal_deviation = 0.2;     ///< standard deviation of the azimuthal blur of the R lobe [rad]
  double aspect = 1;                    ///< minor over major axis of the cross-section, 0 .. 1
  double medulla_ratio = 0;             ///< radius of the medulla over that of the fibre, 0 .. 1
  double medulla_scattering = 0;        ///< of the medulla per fibre radius
  double medulla_absorption = 0;        ///< of the medulla per fibre radius
  double medulla_anisotropy = 0;        ///< mean cosine of its phase function, -1 .. 1
};

/// Settings as `--set` takes them, and one sentence that says how they came about and what the model cannot express.
struct FibreMapping {
  std::string settings, words;
};

}  // namespace cuticle::bsdf
