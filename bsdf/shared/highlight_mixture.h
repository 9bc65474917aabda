#pragma once
// Preparing a HighlightMixture, in double, once a batch.
#include <algorithm>
#include <cmath>

#include "bsdf/shared/highlight_mixture.glslh"

namespace cuticle::bsdf {

/// A highlight to draw from: its share of the energy (any scale), standard deviation in theta_i and shift of its peak,
/// both in radians.
struct Proposal {
  double energy = 0, width = 1, shift = 0;
};

inline LongitudinalLobe<double> lobe_of(const Proposal& proposal) {
  return make_longitudinal_lobe<double>(std::clamp(proposal.width, 5e-4, 2.0), proposal.shift);
}

/// Lobes are drawn in proportion to their energies, the even one at least for a tenth of the samples, so that no
/// direction is left out.
inline HighlightMixture<double> make_mixture(double even_energy, const Proposal& primary, const Proposal& secondary) {
  const double highlights = primary.energy + secondary.energy, total = even_energy + highlights;
  const double even = highlights > 0 ? std::max(0.1, even_energy / total) : 1;
  const double first = secondary.energy > 0 ? (1 - even) * primary.energy / highlights : 1 - even;
  return {even, first, lobe_of(primary), lobe_of(secondary)};
}

/// The integral of cos^(exponent + 1) over a half circle: a highlight's width in theta_i at normal incidence.
inline double highlight_width(double exponent) {
  return std::sqrt(3.14159265358979323846) *
         std::exp(std::lgamma(0.5 * exponent + 1) - std::lgamma(0.5 * exponent + 1.5));
}

/// The mean of a colour's components.
inline double mean_of(const glm::dvec3& color) { return (color.x + color.y + color.z) / 3; }

}  // namespace cuticle::bsdf
