#include <array>
#include <numbers>

#include <fmt/core.h>

#include "bsdf/kajiya_kay/kajiya_kay.glslh"
#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_energy.h"
#include "bsdf/shared/highlight_mixture.h"
#include "core/registry/members.h"

namespace cuticle::bsdf::kajiya_kay {
namespace {

constexpr std::array<std::string_view, 2> lobe_names = {"diffuse", "specular"};
constexpr std::array<std::string_view, 2> measurable = {"specular", "exponent"};
using std::numbers::pi;

struct Parameters {
  glm::dvec3 diffuse{0.05}, specular{0.1};
  double exponent = 25;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.diffuse, "diffuse", "1", 0, 1, "K_d, colour of the diffuse lobe");
  members(p.specular, "specular", "1", 0, 10, "K_s, colour of the highlight");
  members(p.exponent, "exponent", "1", 1, 1e6, "p; the highlight's deviation in theta_i is 1/sqrt(p) rad");
}

// As from_fibre maps the fibres blond, brown and black.
constexpr std::array<registry::StudyCase, 3> presets = {{
    {"blond", "diffuse=0.0731/0.0621/0.042,specular=0.0245,exponent=25"},
    {"brown", "diffuse=0.0326/0.0165/0.00325,specular=0.0245,exponent=25"},
    {"black", "diffuse=0.000186/3.56e-6/0,specular=0.0245,exponent=25"},
}};

constexpr std::array<Exception, 2> exceptions = {{
    {"white_furnace",
     "the coefficients are colours, not shares of energy: diffuse 1 alone scatters pi^2 times the light"},
    {"reciprocity", "the diffuse lobe is a function of the light's inclination only"},
}};

KajiyaKay<double> prepare(const Parameters& p) {
  const Proposal highlight{mean_of(p.specular) * 2 * pi * highlight_width(p.exponent), 1 / std::sqrt(p.exponent), 0};
  return {p.diffuse, p.specular, p.exponent, make_mixture(mean_of(p.diffuse) * pi * pi, highlight, {})};
}

/// The highlight as wide as the fibre's R lobe and with its energy; everything that crosses the fibre is the diffuse
/// colour.
FibreMapping from_fibre(const Fibre& fibre) {
  const FibreEnergy energy = fibre_energy(fibre);
  const double exponent = std::clamp(1 / (fibre.longitudinal_deviation * fibre.longitudinal_deviation), 1.0, 1e6);
  const double specular = energy.reflected / (2 * pi * highlight_width(exponent));
  const glm::dvec3 diffuse = energy.crossed / (pi * pi);
  return {
      fmt::format("diffuse={:.6g}/{:.6g}/{:.6g},specular={:.6g},exponent={:.6g}", diffuse.r, diffuse.g, diffuse.b,
                  specular, exponent),
      "exponent = 1 / longitudinal deviation squared; the specular colour gives the highlight the energy that a smooth "
      "fibre reflects at normal incidence, the diffuse colour has the energy of every path through it; no tilt, no "
      "azimuth, no cross-section, no medulla"};
}

Model table() {
  return {.entry = {.kind = registry::EntryKind::model,
                    .name = "kajiya_kay",
                    .summary = "diffuse sin(t, l) and a highlight cos^p around the cone of reflection; not normalised",
                    .source = "Kajiya and Kay 1989, section 4",
                    .parameters = registry::table_of<Parameters>()},
          .lobes = lobe_names,
          .conventions = {.field = "far",
                          .cosine = "not included",
                          .tilt_sign = "no tilt",
                          .roughness = "exponent of the highlight: 1 / variance in theta_i",
                          .absorption = "none: colours instead"},
          .presets = presets,
          .from_fibre = from_fibre,
          .measurable = measurable,
          .exceptions = exceptions};
}

}  // namespace

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::kajiya_kay
