// Light that scattered more than once, by dual scattering in the place of paths.
#include <algorithm>

#include <glm/geometric.hpp>

#include "render/reference/wave.h"

namespace cuticle::render::reference {

namespace {

/// A ray that fibres leave less than this of is followed no further.
constexpr double k_least_sent_on = 1e-5;

double most_of(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

/// The fibres on the way to a light; none where a surface stands in it.
std::optional<FibresPassed> Wave::fibres_before(std::size_t i, const Arriving& light) const {
  FibresPassed passed;
  glm::dvec3 origin = fibre_points_[i].position;
  strands::FibreLeft from = fibre_points_[i].from;
  const double time = paths_[fibre_paths_[i]].time;
  double left = light.distance;
  while (most_of(passed.sent_on) > k_least_sent_on) {
    const strands::RayHit hit = scene_.rays->closest(origin, light.to_light, from, time);
    if (hit.kind == strands::RayHit::Kind::nothing || hit.distance >= left) return passed;
    if (hit.kind == strands::RayHit::Kind::surface) return std::nullopt;
    const FibrePoint met = scene_.point_of(hit, origin, light.to_light, time);
    scene_.dual_scattering->pass_fibre(glm::dot(met.x, light.to_light), passed);
    origin = met.position;
    from = met.from;
    left -= hit.distance;
  }
  return passed;
}

/// What of a light has passed hair and surfaces, and what other fibres made of it.
Wave::DualLight Wave::dual_light(std::size_t i, const Arriving& light) const {
  const FibreAngles angles = angles_between(glm::dvec3(to_light_[i]), glm::dvec3(to_viewer_[i]));
  if (scene_.transmittance && light.light) {
    const glm::dvec3 arrives = reaching(i, light);
    if (!(most_of(arrives) > 0)) return {};
    return {arrives, scene_.dual_scattering->light_after(arrives, angles), 1};
  }
  const std::optional<FibresPassed> passed = fibres_before(i, light);
  if (!passed) return {};
  return {glm::dvec3(passed->fibres == 0), scene_.dual_scattering->light_after(*passed, angles), passed->fibres};
}

/// Equation 3: direct light, light that fibres before this one sent on, and what comes back from those around.
void Wave::light_by_dual_scattering(std::size_t i, const Arriving& light, const Shares* shares) {
  const std::uint32_t k = fibre_paths_[i];
  const glm::dvec3 arriving = paths_[k].throughput * light.irradiance;
  if (!(most_of(arriving) > 0)) return;
  const DualLight reached = dual_light(i, light);
  add(k, arriving * reached.direct * glm::dvec3(value_[i]), {1, 0, shares});
  add(k, arriving * reached.multiple.onward, {reached.fibres + 1, 0, shares});
  add(k, arriving * reached.multiple.back, {reached.fibres + 2, 1, shares});
}

}  // namespace cuticle::render::reference
