#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "bsdf/chiang/chiang.glslh"
#include "bsdf/chiang/chiang.h"
#include "bsdf/chiang/conversions.h"
#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_table.h"

namespace cuticle::bsdf::chiang {
namespace {

constexpr std::array<std::string_view, 4> lobe_names = {"R", "TT", "TRT", "residual"};
constexpr std::array<std::string_view, 4> measurable = {"sigma_a", "beta_m", "beta_n", "alpha"};
constexpr std::array<std::string_view, 2> fields = {"near", "far"};

constexpr std::array<registry::StudyCase, 5> tiers = {{
    {"near", "field=near"},
    {"far, 1e-2", "field=far,tolerance=1e-2"},
    {"far, 1e-4", "field=far,tolerance=1e-4"},
    {"far, 1e-6", "field=far,tolerance=1e-6"},
    {"far, 1e-10", "field=far,tolerance=1e-10"},
}};
constexpr std::array<Exception, 1> exceptions = {{
    {"reciprocity", "A takes theta_o alone, so exchanging the directions changes the energy of each path"},
}};

Chiang<double> prepare(const Parameters& p) {
  Chiang<double> c = make_chiang<double>(p.eta, p.sigma_a, p.beta_m, p.beta_n, p.alpha);
  const auto [from, to] = std::minmax({p.h_from, p.h_to});
  c.interval = {from, to, to == from ? 0 : 1 / (to - from), p.tolerance};
  c.near_field = p.field == Field::near;
  return c;
}

FibreMapping from_fibre(const Fibre& fibre) {
  const double beta_m = beta_m_from_deviation(fibre.longitudinal_deviation);
  const double beta_n = beta_n_from_scale(scale_from_deviation(fibre.azimuthal_deviation));
  return {fmt::format("eta={:.15g},sigma_a={:.15g}/{:.15g}/{:.15g},beta_m={:.15g},beta_n={:.15g},alpha={:.15g}",
                      fibre.eta, fibre.sigma_a.x, fibre.sigma_a.y, fibre.sigma_a.z, beta_m, beta_n, fibre.scale_tilt),
          "beta_m, beta_n: roughness whose R lobe has these standard deviations in theta_i and phi; alpha: the tilt "
          "itself; "
          "no medulla, circular cross-section, all lobes share one azimuthal width"};
}

bool near_field(const registry::ParameterValues& values) {
  return registry::from_values<Parameters>(values).field == Field::near;
}

Model table() {
  return {
      .entry = {.kind = registry::EntryKind::model,
                .name = "chiang",
                .summary = "circular fibre: R, TT, TRT and all longer paths, near field or averaged over h",
                .source = "Chiang et al. 2016; M of d'Eon et al. 2011",
                .parameters = registry::table_of<Parameters>(),
                .study_cases = tiers},
      .lobes = lobe_names,
      .conventions = {.field = "near or far",
                      .cosine = "not included",
                      .tilt_sign =
                          "positive alpha moves the R lobe toward theta_i + theta_o < 0, the root; opposite to pbrt "
                          "and Tungsten (conversions.h)",
                      .roughness = "the paper's perceptual beta_m and beta_n",
                      .absorption = "per fibre radius"},
      .presets = pigment_presets,
      .near_field = near_field,
      .from_fibre = from_fibre,
      .measurable = measurable,
      .exceptions = exceptions};
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.eta, eta_parameter);
  members(p.sigma_a, sigma_a_parameter);
  members(p.beta_m, "beta_m", "1", 1e-3, 1, "longitudinal roughness, the paper's perceptual scale");
  members(p.beta_n, "beta_n", "1", 1e-3, 1, "azimuthal roughness, the paper's perceptual scale");
  members(p.alpha, "alpha", "rad", -0.17453292519943295, 0.17453292519943295,
          "tilt of the cuticle's scales, positive where they lean to the tip");
  members(p.field, "field", fields, "near: a function of h; far: its mean over h_from .. h_to");
  members(p.h_from, "h_from", "1", -1, 1, "start of the interval of h that the far field takes in");
  members(p.h_to, "h_to", "1", -1, 1, "end of the interval; in either order; at h_from, the far field is 0");
  members(p.tolerance, "tolerance", "1", 1e-12, 0.1, "relative error to which the far field is integrated");
}

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::chiang
