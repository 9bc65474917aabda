#include <array>
#include <numbers>

#include <fmt/core.h>

#include "bsdf/scheuermann/scheuermann.glslh"
#include "bsdf/scheuermann/scheuermann.h"
#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_energy.h"
#include "bsdf/shared/highlight_mixture.h"

namespace cuticle::bsdf::scheuermann {
namespace {

constexpr std::array<std::string_view, 3> lobe_names = {"diffuse", "primary", "secondary"};
constexpr std::array<std::string_view, 6> measurable = {"primary",   "primary_exponent",   "primary_shift",
                                                        "secondary", "secondary_exponent", "secondary_shift"};
constexpr std::array<std::string_view, 3> system_rows = {"A4", "A5", "A6"};
using std::numbers::pi;

// As from_fibre maps the fibres blond, brown and black.
constexpr std::array<registry::StudyCase, 3> presets = {{
    {"blond",
     "diffuse=0.164/0.14/0.0959,primary=0.024,primary_shift=0.044,secondary=0.0058/0.0043/"
     "0.0021,secondary_shift=-0.066"},
    {"brown",
     "diffuse=0.0748/0.0383/0.00764,primary=0.024,primary_shift=0.052,secondary=0.0013/0.00036/"
     "0.000018,secondary_shift=-0.079"},
    {"black", "diffuse=0.00044/8.4e-6/0,primary=0.024,primary_shift=0.052,secondary=9e-8/0/0,secondary_shift=-0.079"},
}};

constexpr std::array<Exception, 2> exceptions = {{
    {"white_furnace", "the colours are no shares of energy: diffuse 1 alone scatters 4 pi / 3 times the light"},
    {"reciprocity", "the normal faces the viewer, and the diffuse lobe is a function of the light's direction only"},
}};

/// What a highlight of colour 1 scatters at normal incidence.
double energy_at_normal(double exponent, double tilt) {
  return highlight_energy<double>({std::sin(tilt), std::cos(tilt), exponent, {}}, 0);
}

Highlight<double> make_highlight(const glm::dvec3& color, double exponent, double tilt) {
  return {std::sin(tilt), std::cos(tilt), exponent, color};
}

/// What to draw it from: its peak T'.H = 0 lies at theta_i + theta_o = -2 tilt, and cos^exponent of half the angle from
/// there falls off with the deviation 2 / sqrt(exponent).
Proposal proposal_of(const glm::dvec3& color, double exponent, double tilt) {
  return {mean_of(color) * energy_at_normal(exponent, tilt), 2 / std::sqrt(exponent), -2 * tilt};
}

Scheuermann<double> prepare(const Parameters& p) {
  const glm::dvec3 all = p.base * p.occlusion, diffuse = all * p.diffuse;
  const glm::dvec3 primary = all * p.primary, secondary = all * p.secondary * p.mask;
  const double texel = p.shift_texture - 0.5;
  const double tilt = std::atan(p.primary_shift + texel), second_tilt = std::atan(p.secondary_shift + texel);
  return {diffuse, make_highlight(primary, p.primary_exponent, tilt),
          make_highlight(secondary, p.secondary_exponent, second_tilt),
          make_mixture(mean_of(diffuse) * 4 * pi / 3, proposal_of(primary, p.primary_exponent, tilt),
                       proposal_of(secondary, p.secondary_exponent, second_tilt))};
}

/// The primary highlight as R, the secondary as TRT, with their widths, shifts and energies; the rest is the diffuse
/// colour.
FibreMapping from_fibre(const Fibre& fibre) {
  const FibreEnergy energy = fibre_energy(fibre);
  const double exponent = std::clamp(4 / (fibre.longitudinal_deviation * fibre.longitudinal_deviation), 1.0, 1e6);
  const double wider = std::max(0.25 * exponent, 1.0), tilt = fibre.scale_tilt;
  const double primary = energy.reflected / energy_at_normal(exponent, tilt);
  const glm::dvec3 secondary = energy.once_inside / energy_at_normal(wider, -1.5 * tilt);
  const glm::dvec3 diffuse = (energy.crossed - energy.once_inside) * (0.75 / pi);
  return {
      fmt::format("diffuse={:.6g}/{:.6g}/{:.6g},primary={:.6g},primary_exponent={:.6g},primary_shift={:.6g},"
                  "secondary={:.6g}/{:.6g}/{:.6g},secondary_exponent={:.6g},secondary_shift={:.6g}",
                  diffuse.r, diffuse.g, diffuse.b, primary, exponent, std::tan(tilt), secondary.r, secondary.g,
                  secondary.b, wider, -std::tan(1.5 * tilt)),
      "primary highlight: R with its energy at normal incidence, exponent 4 / longitudinal deviation squared, shift "
      "tan(tilt); secondary: TRT, twice as wide, shift -tan(1.5 tilt); diffuse: the energy of all other paths; no "
      "azimuthal roughness, no cross-section, no medulla"};
}

Model table() {
  return {
      .entry = {.kind = registry::EntryKind::model,
                .name = "scheuermann",
                .summary =
                    "two shifted highlights sin(T, H)^p and a lerp diffuse term, for hair on polygons; not normalised",
                .source = "Scheuermann 2004, Practical Real-Time Hair Rendering and Shading",
                .parameters = registry::table_of<Parameters>(),
                .systems = system_rows},
      .lobes = lobe_names,
      .conventions = {.field = "far",
                      .cosine = "not included",
                      .tilt_sign = "positive shift reflects toward the root, theta_i + theta_o = -2 atan(shift)",
                      .roughness = "exponent of the highlight: 4 / variance in theta_i",
                      .absorption = "none: colours instead"},
      .presets = presets,
      .from_fibre = from_fibre,
      .measurable = measurable,
      .exceptions = exceptions};
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.base, "base", "1", 0, 1, "base colour, of a texture, on every lobe");
  members(p.occlusion, "occlusion", "1", 0, 1, "ambient occlusion of the vertex, 1: open, on every lobe");
  members(p.diffuse, "diffuse", "1", 0, 1, "colour of the diffuse lobe");
  members(p.primary, "primary", "1", 0, 10, "colour of the primary highlight");
  members(p.primary_exponent, "primary_exponent", "1", 1, 1e6, "of the sine of the angle between T and H");
  members(p.primary_shift, "primary_shift", "1", -1, 1,
          "of the tangent along the normal; positive reflects toward the root");
  members(p.secondary, "secondary", "1", 0, 10, "colour of the secondary highlight");
  members(p.secondary_exponent, "secondary_exponent", "1", 1, 1e6, "of the sine of the angle between T and H");
  members(p.secondary_shift, "secondary_shift", "1", -1, 1,
          "of the tangent along the normal; negative reflects toward the tip");
  members(p.shift_texture, "shift_texture", "1", 0, 1, "texel of the shift texture; 0.5 moves nothing");
  members(p.mask, "mask", "1", 0, 1, "texel of the noise that makes the secondary highlight sparkle");
}

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::scheuermann
