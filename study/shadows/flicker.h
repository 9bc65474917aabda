#pragma once
// How much the error of a shadow method changes from one picture to the next.
#include <optional>
#include <span>
#include <vector>

#include "study/shadows/probes.h"

namespace cuticle::study {

/// Mean change of a setting's transmittance over the receivers with 0.05 < truth < 0.95: less that of the truth when
/// the light turns by 0.1 degree; when all strands but those that span the map move by a tenth of a texel of it.
struct Flicker {
  double light = 0;
  std::optional<double> motion;  ///< not for a method without a resolution
};

/// The unit direction to the light, turned by 0.1 degree about an axis square to it.
glm::dvec3 turned_light(const glm::dvec3& to_light);

/// What every setting of a comparison shares.
struct FlickerScene {
  shadows::Casters casters;
  const Probes* probes = nullptr;
  Weights weights = Weights::at_vertices;
  std::span<const float> truth, turned_truth;  ///< under the light, and under the turned one
};
/// `values`: the candidate's at the probes. Error: what the method refuses.
Result<Flicker> measure_flicker(const Candidate& candidate, const FlickerScene& scene, std::span<const float> values);

}  // namespace cuticle::study
