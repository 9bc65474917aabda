#include "bsdf/materialx/helpers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "bsdf/chiang/conversions.h"
#include "bsdf/pigment/pigment.h"

namespace cuticle::bsdf::materialx {
namespace {

/// (variance, logistic scale over sqrt(pi / 8)) of the lobe, from Chiang's perceptual roughness; helper nodes clamp it
/// from below.
Result<Numbers> roughness(const HairNode& node, std::string_view output) {
  CUTICLE_ASSIGN(const Numbers longitudinal, node.value("longitudinal"));
  CUTICLE_ASSIGN(const Numbers azimuthal, node.value("azimuthal"));
  Numbers scale{1};
  if (output != "roughness_R") {
    CUTICLE_ASSIGN(scale, node.value(output == "roughness_TT" ? "scale_TT" : "scale_TRT"));
  }
  const double deviation = chiang::deviation_from_beta_m(std::max(longitudinal[0], 1e-3)) * scale[0];
  const double width = chiang::scale_from_beta_n(std::max(azimuthal[0], 1e-3)) / std::sqrt(std::numbers::pi / 8);
  return Numbers{deviation * deviation, width};
}

Result<Numbers> absorption_from_color(const HairNode& node) {
  CUTICLE_ASSIGN(const Numbers color, node.value("color"));
  CUTICLE_ASSIGN(const Numbers azimuthal, node.value("azimuthal_roughness"));
  const glm::dvec3 visible(std::max(color[0], 1e-3), std::max(color[1], 1e-3), std::max(color[2], 1e-3));
  CUTICLE_ASSIGN(const glm::dvec3 sigma_a, absorption_of_assembly(visible, azimuthal[0]));
  return Numbers{sigma_a.x, sigma_a.y, sigma_a.z};
}

/// Colours of pigments are exp(-absorption) per unit of concentration.
Result<Numbers> absorption_from_melanin(const HairNode& node) {
  CUTICLE_ASSIGN(const Numbers concentration, node.value("melanin_concentration"));
  CUTICLE_ASSIGN(const Numbers redness, node.value("melanin_redness"));
  CUTICLE_ASSIGN(const Numbers eumelanin, node.value("eumelanin_color"));
  CUTICLE_ASSIGN(const Numbers pheomelanin, node.value("pheomelanin_color"));
  CUTICLE_ASSIGN(const Melanin melanin, melanin_concentrations(concentration[0], redness[0]));
  Numbers sigma_a{};
  for (int c = 0; c < 3; ++c)
    sigma_a[c] = -melanin.eumelanin * std::log(eumelanin[c]) - melanin.pheomelanin * std::log(pheomelanin[c]);
  return sigma_a;
}

Result<Numbers> unchecked_value(const HairNode& node, std::string_view output) {
  const std::string_view category = node.spec().category;
  if (category == "chiang_hair_roughness") return roughness(node, output);
  if (category == "chiang_hair_absorption_from_color") return absorption_from_color(node);
  return absorption_from_melanin(node);
}

}  // namespace

Result<Numbers> helper_value(const HairNode& node, std::string_view output) {
  CUTICLE_ASSIGN(const Numbers value, unchecked_value(node, output));
  if (node.spec().output_type == "vector3")
    for (double sigma_a : value)
      if (!(sigma_a <= 100))
        return bad_input(fmt::format("{}: absorption {} is outside 0 .. 100", node.spec().category, sigma_a));
  return value;
}

}  // namespace cuticle::bsdf::materialx
