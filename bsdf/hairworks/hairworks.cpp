#include <array>
#include <numbers>

#include <fmt/core.h>

#include "bsdf/hairworks/hairworks.glslh"
#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_energy.h"
#include "bsdf/shared/highlight_mixture.h"
#include "core/registry/members.h"

namespace cuticle::bsdf::hairworks {
namespace {

constexpr std::array<std::string_view, 3> lobe_names = {"diffuse", "primary", "secondary"};
constexpr std::array<std::string_view, 5> measurable = {"specular_color", "exponent", "secondary_scale",
                                                        "secondary_width", "secondary_shift"};
constexpr std::array<std::string_view, 2> system_rows = {"H13", "H14"};
using std::numbers::pi;

struct Parameters {
  glm::dvec3 root_color{0.05}, tip_color{0.05};
  double along = 1, root_reach = 1, diffuse_blend = 0, normal_theta = 0, normal_phi = 0;
  glm::dvec3 specular_color{0.05};
  double exponent = 50, secondary_scale = 0.25, secondary_width = 2, secondary_shift = 0.1;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.root_color, "root_color", "1", 0, 1, "colour at the root, of the skin's texture");
  members(p.tip_color, "tip_color", "1", 0, 1, "colour at the tip");
  members(p.along, "along", "1", 0, 1, "place on the strand, 0: root, 1: tip");
  members(p.root_reach, "root_reach", "1", 1e-3, 1,
          "share of the strand over which the root's colour goes over to the tip's");
  members(p.diffuse_blend, "diffuse_blend", "1", 0, 1, "0: diffuse by the strand's tangent, 1: by the body's normal");
  members(p.normal_theta, "normal_theta", "rad", -1.5707963267948966, 1.5707963267948966,
          "inclination of the body's normal, toward the tip");
  members(p.normal_phi, "normal_phi", "rad", -3.141592653589793, 3.141592653589793,
          "azimuth of the body's normal from the viewer's");
  members(p.specular_color, "specular_color", "1", 0, 10, "colour of the primary highlight");
  members(p.exponent, "exponent", "1", 1, 1e6,
          "of the primary highlight; its deviation in theta_i is 1/sqrt(exponent) rad");
  members(p.secondary_scale, "secondary_scale", "1", 0, 1, "peak of the secondary highlight over the primary's");
  members(p.secondary_width, "secondary_width", "1", 1, 10, "width of the secondary highlight over the primary's");
  members(p.secondary_shift, "secondary_shift", "rad", -1, 1,
          "the secondary highlight peaks at theta_i + theta_o = this; positive is toward the tip");
}

// As from_fibre maps the fibres blond, brown and black.
constexpr std::array<registry::StudyCase, 3> presets = {{
    {"blond",
     "root_color=0.0695/0.0594/0.0407,tip_color=0.0695/0.0594/"
     "0.0407,specular_color=0.0245,exponent=25,secondary_scale=0.18"},
    {"brown",
     "root_color=0.0317/0.0162/0.00324,tip_color=0.0317/0.0162/"
     "0.00324,specular_color=0.0245,exponent=25,secondary_scale=0.025"},
    {"black",
     "root_color=0.000186/3.56e-6/0,tip_color=0.000186/3.56e-6/0,specular_color=0.0245,exponent=25,secondary_scale=0"},
}};

constexpr std::array<Exception, 2> exceptions = {{
    {"white_furnace", "the colours are no shares of energy: white hair scatters pi^2 times the light"},
    {"reciprocity", "the diffuse lobe is a function of the light's direction only"},
}};

Hairworks<double> prepare(const Parameters& p) {
  const double toward_tip = std::min(p.along / p.root_reach, 1.0);
  Hairworks<double> m;
  m.diffuse = p.root_color + (p.tip_color - p.root_color) * toward_tip;
  m.primary = p.specular_color;
  m.secondary = m.primary * p.secondary_scale;
  m.primary_exponent = p.exponent;
  m.secondary_exponent = p.exponent / (p.secondary_width * p.secondary_width);
  m.secondary_shift = p.secondary_shift;
  m.blend = p.diffuse_blend;
  m.normal_along = std::sin(p.normal_theta);
  m.normal_across = std::cos(p.normal_theta);
  m.normal_phi = p.normal_phi;
  const Proposal first{mean_of(m.primary) * 2 * pi * highlight_width(m.primary_exponent),
                       1 / std::sqrt(m.primary_exponent), 0};
  const Proposal second{mean_of(m.secondary) * 2 * pi * highlight_width(m.secondary_exponent),
                        1 / std::sqrt(m.secondary_exponent), m.secondary_shift};
  m.mixture = make_mixture(mean_of(m.diffuse) * pi * (pi + m.blend * (1 - pi)), first, second);
  return m;
}

/// The primary highlight as R; the secondary as wide as TRT, where TRT stands, with its mean energy; the rest is the
/// hair's colour.
FibreMapping from_fibre(const Fibre& fibre) {
  const FibreEnergy energy = fibre_energy(fibre);
  const double exponent = std::clamp(1 / (fibre.longitudinal_deviation * fibre.longitudinal_deviation), 1.0, 1e6);
  const double primary = energy.reflected / (2 * pi * highlight_width(exponent));
  const double secondary = mean_of(energy.once_inside) / (2 * pi * highlight_width(exponent / 4));
  const glm::dvec3 color = (energy.crossed - energy.once_inside) / (pi * pi);
  const std::string text = fmt::format("{:.6g}/{:.6g}/{:.6g}", color.r, color.g, color.b);
  return {fmt::format("root_color={},tip_color={},specular_color={:.6g},exponent={:.6g},secondary_scale={:.6g},"
                      "secondary_width=2,secondary_shift={:.6g}",
                      text, text, primary, exponent, std::min(secondary / primary, 1.0), 3 * fibre.scale_tilt),
          "primary highlight: R with its energy at normal incidence, unshifted, exponent 1 / longitudinal deviation "
          "squared; "
          "secondary: TRT's mean energy, without its colour, twice as wide, shifted by 3 tilts; hair colour: the "
          "energy of all "
          "other paths; no azimuthal roughness, no cross-section, no medulla"};
}

Model table() {
  return {
      .entry =
          {.kind = registry::EntryKind::model,
           .name = "hairworks",
           .summary =
               "Kajiya-Kay highlight, a fake secondary one, diffuse between tangent and body normal; not normalised",
           .source = "NVIDIA HairWorks, CGDC 2014; highlights of Kajiya and Kay 1989",
           .parameters = registry::table_of<Parameters>(),
           .systems = system_rows},
      .lobes = lobe_names,
      .conventions =
          {.field = "far",
           .cosine = "not included",
           .tilt_sign = "positive secondary_shift moves the secondary highlight toward theta_i + theta_o > 0, the tip",
           .roughness = "exponent of the highlight: 1 / variance in theta_i",
           .absorption = "none: colours instead"},
      .presets = presets,
      .from_fibre = from_fibre,
      .measurable = measurable,
      .exceptions = exceptions};
}

}  // namespace

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::hairworks
