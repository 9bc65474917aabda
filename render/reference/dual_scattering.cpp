#include "render/reference/dual_scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bsdf/dual_scattering/kept_terms.h"

namespace cuticle::render::reference {

namespace {

using bsdf::dual_scattering::ScatteringLobe;

constexpr double k_least_squared = 1e-3;  // of cos^2 theta_d, as in dual_scattering.glsl

ScatteringLobe<double> lobe_of(const bsdf::HalfScattering& half, int channel) {
  return {half.share[channel], half.shift[channel], half.deviation[channel] * half.deviation[channel]};
}

}  // namespace

FibreAngles angles_between(const glm::dvec3& to_light, const glm::dvec3& to_viewer) {
  const double turned =
      std::abs(std::atan2(to_viewer.z, to_viewer.y) - std::atan2(to_light.z, to_light.y)) / std::numbers::pi;
  return {.theta_i = std::asin(std::clamp(to_light.x, -1.0, 1.0)),
          .theta_o = std::asin(std::clamp(to_viewer.x, -1.0, 1.0)),
          .away = std::min(turned, 2 - turned)};
}

Result<DualScattering> DualScattering::make(const bsdf::Model& model, const registry::ParameterValues& values,
                                            const DualScatteringInstead& choice) {
  DualScattering made;
  made.choice_ = choice;
  CUTICLE_ASSIGN(made.table_, bsdf::kept_dual_scattering_terms(model, values));
  return made;
}

void DualScattering::pass_fibre(double sine, FibresPassed& passed) const {
  const bsdf::HalfScattering forward = table_.at(std::asin(std::clamp(sine, -1.0, 1.0))).average.forward;
  ++passed.fibres;
  passed.sent_on *= forward.share;
  passed.spread += forward.deviation * forward.deviation + choice_.direction_spread * choice_.direction_spread;
}

DualScattering::Averages DualScattering::averages_of(const bsdf::DualScatteringRow& local,
                                                     const bsdf::DualScatteringRow& path, int c) const {
  const bsdf::MultipleBackscattering& multiple = local.multiple;
  return {lobe_of(path.average.forward, c), lobe_of(local.average.forward, c), lobe_of(local.average.backward, c),
          lobe_of({multiple.attenuation, multiple.shift, multiple.deviation}, c)};
}

/// Equation 3 with the paper's lobes over pi cos^2 theta_d, no cosine left to be applied.
template <class ScatteredOf>
MultipleLight DualScattering::light(const FibreAngles& angles, const ScatteredOf& scattered_of) const {
  const double theta_d = (angles.theta_o - angles.theta_i) / 2, cosine = std::cos(theta_d);
  const double inclined = std::cos(angles.theta_i) / (std::numbers::pi * std::max(cosine * cosine, k_least_squared));
  const bsdf::DualScatteringRow local = table_.at(theta_d), path = table_.at(angles.theta_i);
  const double spread = choice_.direction_spread * choice_.direction_spread;
  MultipleLight result;
  for (int c = 0; c < 3; ++c) {
    const Scattered scattered = scattered_of(averages_of(local, path, c), spread, c);
    result.onward[c] = inclined * choice_.forward_density * scattered.onward;
    result.back[c] =
        inclined * choice_.backward_density * (scattered.back + choice_.forward_density * scattered.onward_back);
  }
  return result;
}

MultipleLight DualScattering::light_after(const FibresPassed& passed, const FibreAngles& angles) const {
  const bool direct = passed.fibres == 0;
  return light(angles, [&](const Averages& fibre, double bent, int c) {
    return bsdf::dual_scattering::scattered_after<double>(fibre, direct ? 1 : 0,
                                                          {direct ? 0 : passed.sent_on[c], passed.spread[c]},
                                                          angles.theta_i, angles.theta_o, angles.away, bent);
  });
}

MultipleLight DualScattering::light_after(const glm::dvec3& transmittance, const FibreAngles& angles) const {
  return light(angles, [&](const Averages& fibre, double bent, int c) {
    const double arrives = std::clamp(transmittance[c], double(bsdf::dual_scattering::k_min_transmittance), 1.0);
    return bsdf::dual_scattering::scattered_light<double>(fibre, arrives, angles.theta_i, angles.theta_o, angles.away,
                                                          bent);
  });
}

}  // namespace cuticle::render::reference
