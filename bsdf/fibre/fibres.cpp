#include "bsdf/fibre/fibres.h"

#include <array>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace cuticle::bsdf {
namespace {

constexpr double degree = 0.017453292519943295;

/// What the pigments of the table deon_pbrt absorb.
NamedFibre with_pigments(NamedFibre named) {
  const PigmentTable& table = pigment_tables()[0];
  named.fibre.sigma_a = table.eumelanin * named.pigments.eumelanin + table.pheomelanin * named.pigments.pheomelanin;
  return named;
}

/// Human hair: index 1.55, scales that lean by 2 .. 4 degrees, radii and cross-sections of the usual ranges (Robbins
/// 2012).
NamedFibre human(std::string_view name, std::string_view summary, Melanin pigments, double radius, double tilt_deg,
                 double aspect) {
  NamedFibre named{name, summary, pigments, {}};
  named.fibre.radius = radius;
  named.fibre.scale_tilt = tilt_deg * degree;
  named.fibre.aspect = aspect;
  return with_pigments(named);
}

/// Fur: a wide medulla that scatters forward, rounder scales (values chosen within the ranges of Yan et al. 2015).
NamedFibre fur(std::string_view name, std::string_view summary, Melanin pigments, double medulla_ratio,
               double medulla_scattering) {
  NamedFibre named{name, summary, pigments, {}};
  named.fibre.radius = 20e-6;
  named.fibre.scale_tilt = 3 * degree;
  named.fibre.longitudinal_deviation = 0.15;
  named.fibre.azimuthal_deviation = 0.15;
  named.fibre.medulla_ratio = medulla_ratio;
  named.fibre.medulla_scattering = medulla_scattering;
  named.fibre.medulla_absorption = 0.05;
  named.fibre.medulla_anisotropy = 0.5;
  return with_pigments(named);
}

const std::array<NamedFibre, 9>& named_fibres() {
  static const std::array<NamedFibre, 9> all = {
      human("blond", "little eumelanin", {0.3, 0}, 30e-6, 2.5, 0.85),
      human("brown", "eumelanin", {1.3, 0}, 35e-6, 3, 0.85),
      human("black", "much eumelanin, thick and round", {8, 0}, 45e-6, 3, 0.95),
      human("red", "mostly pheomelanin", {0.2, 1.6}, 32e-6, 3, 0.85),
      human("grey", "a trace of eumelanin", {0.08, 0}, 38e-6, 3, 0.9),
      human("white", "no pigment", {0, 0}, 38e-6, 3, 0.9),
      fur("fur_white", "no pigment, wide medulla", {0, 0}, 0.8, 2),
      fur("fur_brown", "eumelanin around a wide medulla", {1, 0.2}, 0.7, 2),
      fur("fur_grey", "little eumelanin around a medulla of middle size", {0.3, 0}, 0.5, 3),
  };
  return all;
}

}  // namespace

std::span<const NamedFibre> fibres() { return named_fibres(); }

Result<NamedFibre> find_fibre(std::string_view name) {
  std::vector<std::string_view> known;
  for (const NamedFibre& fibre : named_fibres()) {
    if (fibre.name == name) return fibre;
    known.push_back(fibre.name);
  }
  const std::string near = registry::nearest_name(name, known);
  return usage_error(fmt::format("hair '{}' is not one of {}", name, fmt::join(known, ", ")),
                     near.empty() ? std::string() : fmt::format("did you mean {}?", near));
}

}  // namespace cuticle::bsdf
