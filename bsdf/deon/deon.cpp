#include <array>
#include <cmath>

#include <fmt/core.h>

#include "bsdf/deon/deon.glslh"
#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_table.h"
#include "core/registry/members.h"

namespace cuticle::bsdf::deon {
namespace {

constexpr std::array<std::string_view, 4> lobe_names = {"R", "TT", "TRT", "residual"};
constexpr std::array<std::string_view, 4> measurable = {"sigma_a", "beta_m", "beta_n", "alpha"};
constexpr std::array<std::string_view, 2> r_lobes = {"separable", "non_separable"};
constexpr std::array<std::string_view, 2> attenuation_angles = {"theta_o", "theta_d"};
constexpr std::array<std::string_view, 1> system_rows = {"G7"};

enum class RLobe { separable, non_separable };
enum class AttenuationAngle { theta_o, theta_d };
struct Parameters {
  double eta = 1.55;
  glm::dvec3 sigma_a{0.2};
  double beta_m = 0.2, beta_n = 0.2, alpha = -0.05235987755982988, azimuthal_tolerance = 1e-6;
  RLobe r_lobe = RLobe::separable;
  AttenuationAngle attenuation_angle = AttenuationAngle::theta_o;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.eta, eta_parameter);
  members(p.sigma_a, sigma_a_parameter);
  members(p.beta_m, "beta_m", "rad", 1e-3, 1,
          "standard deviation of the R lobe in theta_i; TT has half of it, TRT twice");
  members(p.beta_n, "beta_n", "rad", 1e-3, 1,
          "standard deviation of the azimuthal blur of the R lobe; TT has half of it, TRT twice");
  members(p.alpha, "alpha", "rad", -0.17453292519943295, 0.17453292519943295,
          "shift of the R lobe in theta_h by the cuticle's scales");
  members(p.azimuthal_tolerance, "azimuthal_tolerance", "1", 1e-12, 0.1,
          "relative error of the azimuthal quadrature's panels");
  members(p.r_lobe, "r_lobe", r_lobes, "separable: 2011; non_separable: width and shift of R depend on phi, 2014");
  members(p.attenuation_angle, "attenuation_angle", attenuation_angles,
          "theta_o: energy is kept exactly; theta_d: as the paper, reciprocal where alpha is 0");
}

constexpr std::array<registry::StudyCase, 3> tiers = {{
    {"tolerance 1e-2", "azimuthal_tolerance=1e-2"},
    {"tolerance 1e-4", "azimuthal_tolerance=1e-4"},
    {"tolerance 1e-8", "azimuthal_tolerance=1e-8"},
}};
constexpr std::array<Exception, 2> exceptions = {{
    {"reciprocity", "attenuation belongs to theta_o, which keeps energy; attenuation_angle=theta_d is reciprocal",
     "attenuation_angle=theta_o"},
    furnace_at_theta_d,
}};

Deon<double> prepare(const Parameters& p) {
  Deon<double> m;
  m.r = make_longitudinal_lobe(p.beta_m, 2 * p.alpha);
  m.tt = make_longitudinal_lobe(p.beta_m / 2, -p.alpha);
  m.trt = make_longitudinal_lobe(p.beta_m * 2, -3 * p.alpha);
  m.wide_r = make_detector(p.beta_n);
  m.wide_tt = make_detector(p.beta_n / 2);
  m.wide_trt = make_detector(p.beta_n * 2);
  m.dielectric = {p.eta * p.eta, (p.eta - 1) * (p.eta + 1), p.sigma_a};
  m.accuracy = make_accuracy(p.azimuthal_tolerance);
  m.beta_m = p.beta_m;
  m.sin_alpha = std::sin(p.alpha);
  m.cos_alpha = std::cos(p.alpha);
  m.non_separable = p.r_lobe == RLobe::non_separable;
  m.at_theta_o = p.attenuation_angle == AttenuationAngle::theta_o;
  return m;
}

FibreMapping from_fibre(const Fibre& fibre) {
  return {fmt::format("eta={:.15g},sigma_a={:.15g}/{:.15g}/{:.15g},beta_m={:.15g},beta_n={:.15g},alpha={:.15g}",
                      fibre.eta, fibre.sigma_a.x, fibre.sigma_a.y, fibre.sigma_a.z, fibre.longitudinal_deviation,
                      fibre.azimuthal_deviation, -fibre.scale_tilt),
          "deviations and tilt as they are; the cross-section is a circle and there is no medulla"};
}

Model table() {
  return {.entry = {.kind = registry::EntryKind::model,
                    .name = "deon",
                    .summary = "rough circular fibre: energy-conserving M, N by adaptive quadrature with its error",
                    .source = "d'Eon et al. 2011; R lobe of d'Eon, Marschner and Hanika 2014",
                    .parameters = registry::table_of<Parameters>(),
                    .systems = system_rows,
                    .study_cases = tiers},
          .lobes = lobe_names,
          .conventions = conventions_of_shift("far", "standard deviation in theta_i and in phi"),
          .presets = pigment_presets,
          .from_fibre = from_fibre,
          .measurable = measurable,
          .exceptions = exceptions};
}

}  // namespace

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::deon
