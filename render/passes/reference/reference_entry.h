#pragma once
#include "render/pass.h"

namespace cuticle::render::reference {

struct Parameters {
  static constexpr std::string_view name = "reference";
  int samples = 64, bounces = 0;
  double max_error = 0;
  std::uint64_t seed = 0;
  bool far_field = false;
  double point_light_radius = 0, sun_angle = 0;
  double clamp_indirect = 0;
  double twist = 0;
  std::uint64_t turn_seed = 0;
  bool tables = false;
  bool dual_scattering = false;  ///< with the numbers of the scene's pass of that name, or its defaults
  std::string shadow = "traced";        ///< or the name of a shadow method
  std::string curves = "round_linear";  ///< what vertices are: strands::curve_kind_names()
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::reference
