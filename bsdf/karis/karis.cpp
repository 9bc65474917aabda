#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "bsdf/karis/karis.glslh"
#include "bsdf/shared/batch.h"
#include "core/registry/members.h"

namespace cuticle::bsdf::karis {
namespace {

constexpr std::array<std::string_view, 3> lobe_names = {"R", "TT", "TRT"};
constexpr std::array<std::string_view, 3> measurable = {"color", "roughness", "shift"};

struct Parameters {
  glm::dvec3 color{0.449328964117222};
  double roughness = 0.5, shift = 0.035;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.color, "color", "1", 0, 1, "what a path of four radii leaves of the light");
  members(p.roughness, "roughness", "1", 0.032, 1, "its square is the deviation of R in sin theta_i");
  members(p.shift, "shift", "rad", -0.17453292519943295, 0.17453292519943295,
          "tilt of the cuticle's scales: R moves by -2, TT by 1, TRT by 4 times it");
}

// color = exp(-4 sigma_a) of pigment_presets (fibre_table.h).
constexpr std::array<registry::StudyCase, 3> presets = {{
    {"blond", "color=0.6048/0.4333/0.1932"},
    {"brown", "color=0.1132/0.02667/0.000806"},
    {"black", "color=1.504e-6/2.064e-10/9.125e-20"},
}};

constexpr std::array<Exception, 2> exceptions = {{
    {"white_furnace", "lobes fitted one by one, with Schlick's reflectance and a Gaussian that ends at the poles"},
    {"absorbing_furnace",
     "color stands for a length of path, which the fits take at one offset and divide by cos theta_d"},
}};

/// -ln of a colour; black counts as exp(-400).
glm::dvec3 density_of(const glm::dvec3& color) {
  const auto density = [](double share) { return std::min(-std::log(std::max(share, 1e-300)), 400.0); };
  return {density(color.r), density(color.g), density(color.b)};
}

Karis<double> prepare(const Parameters& p) { return make_karis<double>(density_of(p.color), p.roughness, p.shift); }

FibreMapping from_fibre(const Fibre& fibre) {
  const double roughness = std::clamp(std::sqrt(fibre.longitudinal_deviation), 0.032, 1.0);
  const double shift = std::clamp(fibre.scale_tilt, 0.0, 0.17453292519943295);
  const glm::dvec3& s = fibre.sigma_a;
  return {
      fmt::format("color={:.8g}/{:.8g}/{:.8g},roughness={:.8g},shift={:.8g}", std::exp(-4 * s.r), std::exp(-4 * s.g),
                  std::exp(-4 * s.b), roughness, shift),
      "color = exp(-4 sigma_a), what two central crossings leave; roughness is the root of the longitudinal "
      "deviation, shift the tilt of the scales; the index is 1.55 and the azimuthal widths are those of the fit; no "
      "cross-section, no medulla"};
}

Model table() {
  return {.entry = {.kind = registry::EntryKind::model,
                    .name = "karis",
                    .summary = "closed forms fitted to R, TT and TRT for real-time shading",
                    .source = "Karis 2016, SIGGRAPH course Physically based shading",
                    .parameters = registry::table_of<Parameters>()},
          .lobes = lobe_names,
          .conventions = {.field = "far",
                          .cosine = "not included",
                          .tilt_sign = "positive shift moves the R lobe toward theta_i + theta_o < 0, the root",
                          .roughness = "root of the standard deviation in sin theta_i",
                          .absorption = "color = exp(-4 sigma_a), sigma_a per fibre radius"},
          .presets = presets,
          .from_fibre = from_fibre,
          .measurable = measurable,
          .exceptions = exceptions};
}

}  // namespace

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::karis
