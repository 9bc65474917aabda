#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_table.h"
#include "bsdf/yan_fur/way_out.h"
#include "bsdf/yan_fur/yan_fur.glslh"
#include "core/registry/members.h"

namespace cuticle::bsdf::yan_fur {
namespace {

constexpr std::array<std::string_view, 6> lobe_names = {"R", "TT", "TRT", "TTs", "TRTs", "residual"};
constexpr std::array<std::string_view, 7> measurable = {"sigma_a", "beta_m",   "beta_n", "alpha",
                                                        "kappa",   "sigma_ms", "layers"};
constexpr std::array<std::string_view, 2> fields = {"far", "near"};
constexpr std::array<std::string_view, 2> attenuation_angles = {"theta_o", "theta_d"};
constexpr std::array<std::string_view, 1> system_rows = {"G7"};
constexpr double largest_anisotropy = 0.9;

enum class Field { far, near };
enum class AttenuationAngle { theta_o, theta_d };
struct Parameters {
  double eta = 1.55;
  glm::dvec3 sigma_a{0.2};
  double kappa = 0.7, sigma_ms = 2, sigma_ma = 0.1, g = 0.4, layers = 1;
  double beta_m = 0.2, beta_n = 0.2, alpha = -0.05235987755982988, azimuthal_tolerance = 1e-6;
  Field field = Field::far;
  AttenuationAngle attenuation_angle = AttenuationAngle::theta_o;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.eta, "eta", "1", 1.05, 3, "refractive index of cortex and medulla");
  members(p.sigma_a, "sigma_a", "1/radius", 0, 100, "absorption of the cortex per fibre radius");
  members(p.kappa, "kappa", "1", 0, 0.99, "radius of the medulla over that of the fibre");
  members(p.sigma_ms, "sigma_ms", "1/radius", 0, 100, "scattering of the medulla per fibre radius");
  members(p.sigma_ma, "sigma_ma", "1/radius", 0, 100, "absorption of the medulla per fibre radius");
  members(p.g, "g", "1", -largest_anisotropy, largest_anisotropy, "mean cosine of the medulla's phase function");
  members(p.layers, "layers", "1", 0.1, 10, "layers of the cuticle, which reflect together");
  members(p.beta_m, "beta_m", "rad", 1e-3, 1,
          "standard deviation of the R lobe in theta_i; TT has half of it, TRT 3/2");
  members(p.beta_n, "beta_n", "rad", 1e-3, 1,
          "standard deviation of the azimuthal blur of the R lobe; TT has sqrt(2), TRT sqrt(3) of it");
  members(p.alpha, "alpha", "rad", -0.17453292519943295, 0.17453292519943295,
          "shift of the R lobe in theta_h by the cuticle's scales (half the paper's, which is in theta_i)");
  members(p.azimuthal_tolerance, "azimuthal_tolerance", "1", 1e-12, 0.1,
          "relative error of the far field's azimuthal quadrature");
  members(p.field, "field", fields, "far: averaged over the fibre; near: at an offset h");
  members(p.attenuation_angle, "attenuation_angle", attenuation_angles,
          "theta_o: energy is kept exactly; theta_d: reciprocal where alpha is 0, scattered light even over theta_i");
}

constexpr std::array<registry::StudyCase, 4> tiers = {{
    {"near field", "field=near"},
    {"tolerance 1e-2", "azimuthal_tolerance=1e-2"},
    {"tolerance 1e-4", "azimuthal_tolerance=1e-4"},
    {"tolerance 1e-8", "azimuthal_tolerance=1e-8"},
}};
constexpr std::array<Exception, 2> exceptions = {{
    {"reciprocity",
     "attenuation belongs to theta_o, which keeps energy, and scattered light leaves by Lambert's law; "
     "attenuation_angle=theta_d is reciprocal",
     "attenuation_angle=theta_o"},
    furnace_at_theta_d,
}};

/// Width of the von Mises-Fisher lobe whose mean cosine is `mean`, in (0, 1): 1/tanh(1/v) - v = mean, bisected in v.
double width_of_mean(double mean) {
  double low = 1e-3, high = 1e3;
  for (int k = 0; k < 200; ++k) {
    const double variance = std::sqrt(low * high);
    // Below a mean of 1/3 the difference cancels, and 1/(3 v) is as good.
    const double at = variance > 30 ? 1 / (3 * variance) : 1 / std::tanh(1 / variance) - variance;
    (at > mean ? low : high) = variance;
  }
  return std::sqrt(low);
}

/// The medulla's light, fitted to walks (README.md): the lobe thrown forward has the phase function's mean, and the
/// share that keeps to it falls with the mean depth of the medulla, sigma_ms kappa pi / 2.
LongitudinalLobe<double> thrown_lobe(double g) {
  return make_longitudinal_lobe<double>(width_of_mean(std::max(g, 0.01)), 0);
}
double directed_share(const Parameters& p) {
  const double mean_depth = p.sigma_ms * p.kappa * 1.5707963267948966;
  return std::max(p.g, 0.0) * std::exp(-0.3 * mean_depth);
}
Medulla<double> make_medulla(const Parameters& p) {
  Medulla<double> m;
  m.kappa = p.kappa;
  m.scattering = p.sigma_ms;
  m.absorption = p.sigma_ma;
  m.single_turn = p.g * (0.65 + 0.25 * p.g);
  m.log_rate = -3.4 + 2.6 * p.g - 1.1 * p.g * p.g;
  m.power = 1.37 - 0.85 * p.g + 0.25 * p.g * p.g;
  m.left = share_let_out({p.eta, p.layers, p.sigma_a, p.kappa, p.sigma_ms, p.sigma_ma});
  return m;
}

YanFur<double> prepare(const Parameters& p) {
  YanFur<double> m;
  m.r = make_longitudinal_lobe(p.beta_m, 2 * p.alpha);
  m.tt = make_longitudinal_lobe(p.beta_m / 2, -p.alpha);
  m.trt = make_longitudinal_lobe(p.beta_m * 1.5, -3 * p.alpha);
  m.thrown = thrown_lobe(p.g);
  m.wide_r = make_detector(p.beta_n);
  m.wide_tt = make_detector(p.beta_n * std::sqrt(2.0));
  m.wide_trt = make_detector(p.beta_n * std::sqrt(3.0));
  m.dielectric = {p.eta * p.eta, (p.eta - 1) * (p.eta + 1), p.sigma_a};
  m.medulla = make_medulla(p);
  m.accuracy = make_accuracy(p.azimuthal_tolerance);
  m.layers = p.layers;
  m.directed = directed_share(p);
  m.near_field = p.field == Field::near;
  m.symmetric = p.attenuation_angle == AttenuationAngle::theta_d;
  return m;
}

bool is_near(const registry::ParameterValues& values) {
  return registry::from_values<Parameters>(values).field == Field::near;
}

FibreMapping from_fibre(const Fibre& fibre) {
  return {fmt::format("eta={:.15g},sigma_a={:.15g}/{:.15g}/"
                      "{:.15g},kappa={:.15g},sigma_ms={:.15g},sigma_ma={:.15g},g={:.15g},layers=1,"
                      "beta_m={:.15g},beta_n={:.15g},alpha={:.15g}",
                      fibre.eta, fibre.sigma_a.x, fibre.sigma_a.y, fibre.sigma_a.z, std::min(fibre.medulla_ratio, 0.99),
                      fibre.medulla_scattering, fibre.medulla_absorption,
                      std::clamp(fibre.medulla_anisotropy, -largest_anisotropy, largest_anisotropy),
                      fibre.longitudinal_deviation, fibre.azimuthal_deviation, -fibre.scale_tilt),
          "deviations, tilt and medulla as they are, with one layer of cuticle; the cross-section is a circle"};
}

Model table() {
  return {.entry = {.kind = registry::EntryKind::model,
                    .name = "yan_fur",
                    .summary = "fur: rough cortex around a scattering medulla, near and far field",
                    .source = "Yan et al. 2017; M of d'Eon et al. 2011",
                    .parameters = registry::table_of<Parameters>(),
                    .systems = system_rows,
                    .study_cases = tiers},
          .lobes = lobe_names,
          .conventions = conventions_of_shift("near or far", "standard deviation in theta_i and in phi"),
          .presets = pigment_presets,
          .near_field = is_near,
          .from_fibre = from_fibre,
          .measurable = measurable,
          .exceptions = exceptions};
}

}  // namespace

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::yan_fur
