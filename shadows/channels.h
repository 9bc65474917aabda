#pragma once
// Transmittance per channel: hair that takes away other parts of red, green and blue light.
#include <array>
#include <optional>

#include <glm/vec3.hpp>

#include "shadows/method.h"

namespace cuticle::shadows {

/// The different ones among a crossing's opacities of three channels, and which of them a channel has.
struct Channels {
  std::array<double, 3> alpha{0.4, 0, 0};    ///< the first `count`
  std::array<std::uint32_t, 3> of{0, 0, 0};  ///< of red, green, blue: an index of `alpha`
  std::uint32_t count = 1;
};
/// In the order of red, green, blue. Equal opacities, 0 .. 1, are one.
Channels different_channels(const glm::dvec3& alpha);

/// The opacity, an index of `alpha`, whose T's powers are those of the others (channels.glslh): the least above 0 of a
/// method that is proportional (Method::is_proportional). None: each opacity is evaluated, because the optical depth of
/// a partly covered texel, -ln(1 - alpha c), is not proportional to alpha; also where there is one, and below 0.01,
/// which sums of whole numbers round too coarsely for others. Method and values as in evaluate_channels.
std::optional<std::uint32_t> root_opacity(const Method& method, const registry::ParameterValues& values,
                                          const Channels& channels);

/// Transmittance in [0, 1] of each channel, one per receiver.
struct ColouredTransmittance {
  std::vector<glm::vec3> values;
  Cost cost;  ///< of all evaluations together; `bytes` of the largest structure
};

/// The method for a crossing's opacity in each channel, 0 .. 1: one evaluation for each different one, or for all by
/// root_opacity. Errors: the method's, and those of `check`.
Result<ColouredTransmittance> evaluate_channels(const Method& method, const Casters& casters, const glm::dvec3& alpha,
                                                const Receivers& receivers, const registry::ParameterValues& values);

}  // namespace cuticle::shadows
