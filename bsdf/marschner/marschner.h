#pragma once
// The model's parameters.
#include <cstdint>

#include "core/registry/members.h"

namespace cuticle::bsdf::marschner {

enum class Variant { corrected, as_published };
enum class CausticKind { exact, smoothed };
enum class AttenuationAngle { theta_d, theta_o };
/// Defaults: the middle of the paper's ranges. Its beta_R of 5 .. 10 degrees is a width in theta_h, so 7.5 is 15
/// degrees in theta_i.
struct Parameters {
  double eta = 1.55;
  glm::dvec3 sigma_a{0.2};
  double beta = 0.2617993877991494, alpha = -0.1308996938995747;
  Variant variant = Variant::corrected;
  double aspect = 1;
  std::int64_t turns = 0;
  CausticKind caustic = CausticKind::exact;
  double k_g = 0.5, w_c = 0.17453292519943295, delta_eta = 0.2, delta_h_max = 0.5;
  AttenuationAngle attenuation_angle = AttenuationAngle::theta_d;
};
void describe(registry::Members& members, Parameters& p);

}  // namespace cuticle::bsdf::marschner
