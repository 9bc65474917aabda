#pragma once
// Transmittance per channel: hair that takes away other parts of red, green and blue light.
#include <glm/vec3.hpp>

#include <cuticle/shadows/method.h>

namespace cuticle::shadows {

/// Transmittance in [0, 1] of each channel, one per receiver.
struct ColouredTransmittance {
  std::vector<glm::vec3> values;
  Cost cost;  ///< of all evaluations together; `bytes` of the largest structure
};

/// The method for a crossing's opacity in each channel, 0 .. 1: one evaluation for each different one, because the
/// optical depth of a partly covered texel, -ln(1 - alpha c), is not proportional to alpha. Errors: the method's.
Result<ColouredTransmittance> evaluate_channels(const Method& method, const Casters& casters, const glm::dvec3& alpha,
                                                const Receivers& receivers, const registry::ParameterValues& values);

}  // namespace cuticle::shadows
