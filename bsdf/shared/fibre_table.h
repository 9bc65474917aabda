#pragma once
// What tables of models of physical fibres have in common: parameters, presets, conventions, exceptions.
#include <array>

#include "bsdf/model.h"

namespace cuticle::bsdf {

inline constexpr registry::Parameter eta_parameter = {"eta", registry::ParameterType::real,  "1", 1.05, 3, "1.55",
                                                      {},    "refractive index of the fibre"};
inline constexpr registry::Parameter sigma_a_parameter = {
    "sigma_a",  registry::ParameterType::rgb,
    "1/radius", 0,
    100,        "0.2",
    {},         "absorption per fibre radius, for red, green and blue"};

/// sigma_a from pigment: eumelanin (0.419, 0.697, 1.37) per unit of concentration (d'Eon et al. 2011, as tabulated in
/// pbrt), concentration 0.3 blond, 1.3 brown, 8 black (pbrt).
inline constexpr std::array<registry::StudyCase, 3> pigment_presets = {{
    {"blond", "eta=1.55,sigma_a=0.1257/0.2091/0.411"},
    {"brown", "eta=1.55,sigma_a=0.5447/0.9061/1.781"},
    {"black", "eta=1.55,sigma_a=3.352/5.576/10.96"},
}};

/// Of models whose alpha shifts the R lobe as the paper of Marschner et al. has it.
constexpr Conventions conventions_of_shift(std::string_view field, std::string_view roughness) {
  return {
      .field = field,
      .cosine = "not included",
      .tilt_sign = "positive alpha moves the R lobe toward theta_i + theta_o > 0, the tip; that of hair is negative",
      .roughness = roughness,
      .absorption = "per fibre radius"};
}

/// Of models that can take attenuation at theta_d.
inline constexpr Exception furnace_at_theta_d = {
    "white_furnace", "paths of different widths take their shares at different theta_d", "attenuation_angle=theta_d"};

}  // namespace cuticle::bsdf
