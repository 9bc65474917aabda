#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <fmt/core.h>

#include "bsdf/marschner/marschner.glslh"
#include "bsdf/marschner/marschner.h"
#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_table.h"
#include "bsdf/turns.h"

namespace cuticle::bsdf::marschner {
namespace {

constexpr std::array<std::string_view, 3> lobe_names = {"R", "TT", "TRT"};
constexpr std::array<std::string_view, 3> measurable = {"sigma_a", "beta", "alpha"};
constexpr std::array<std::string_view, 2> variants = {"corrected", "as_published"};
constexpr std::array<std::string_view, 2> caustics = {"exact", "smoothed"};
constexpr std::array<std::string_view, 2> attenuation_angles = {"theta_d", "theta_o"};
constexpr std::array<std::string_view, 4> system_rows = {"N11", "N16", "G1", "G7"};

// The last is what the others are compared with: the paper's cubic and its M, and its caustic without singularities.
constexpr std::array<registry::StudyCase, 3> tiers = {{
    {"as_published, cubic roots", "variant=as_published"},
    {"smoothed caustic", "caustic=smoothed"},
    {"exact roots", "variant=corrected,caustic=exact"},
}};

/// Where N_TRT reaches further than the exits of a round fibre; found by trying for a low variance (README.md).
AzimuthMixture<double> mixture_for(const Marschner<double>& m) {
  const double glow = m.removal.acts ? 0.4 : 0;
  const double even = m.as_published || m.ellipse.acts ? 0.3 : m.removal.acts ? 0.1 : 0;
  return {glow, even};
}

Marschner<double> prepare(const Parameters& p) {
  Marschner<double> m = make_marschner<double>(p.eta, p.sigma_a, p.beta, p.alpha);
  m.as_published = p.variant == Variant::as_published;
  m.removal = {p.k_g, p.w_c, p.delta_eta, p.delta_h_max, p.caustic == CausticKind::smoothed};
  m.ellipse = make_ellipse(p.eta, p.aspect);
  m.ellipse.turns = double(p.turns);
  m.mixture = mixture_for(m);
  m.at_theta_o = !m.as_published && p.attenuation_angle == AttenuationAngle::theta_o;
  return m;
}

/// Means over intervals of one theta_d after another; what two neighbours share is found once.
class AzimuthalMeans {
 public:
  AzimuthalMeans(const Marschner<double>& m, int lobe) : m_(m), lobe_(lobe) {}
  AzimuthMean of(const AzimuthInterval& interval) {
    set_theta_d(interval.theta_d);
    const bool singular =
        has_one_caustic(m_) && is_singular_between(turns_[0].caustic, lobe_, interval.begin, interval.end);
    if (lobe_ != 2) return {mean_smooth(own_, lobe_, interval.begin, interval.end), singular};
    glm::dvec3 sum(0);
    for (Turn& turn : turns_) sum += turn.mean(interval);
    return {sum * weight_of_turn(m_.ellipse), singular};
  }

 private:
  struct Edge {
    double phi = -1;
    TrtRoots<double> roots{};
  };
  /// TRT of one index.
  struct Turn {
    Refraction<double> refraction{};
    Caustic<double> caustic{};
    std::array<Edge, 2> edges{};
    TrtRoots<double> roots_at(double phi) const {
      for (const Edge& edge : edges)
        if (edge.phi == phi) return edge.roots;
      return trt_roots(refraction, caustic, phi);
    }
    glm::dvec3 mean(const AzimuthInterval& interval) {
      const TrtRoots<double> begin = roots_at(interval.begin), end = roots_at(interval.end);
      edges = {{{interval.begin, begin}, {interval.end, end}}};
      return mean_trt(refraction, caustic, begin, end, interval.end - interval.begin);
    }
  };
  void set_theta_d(double theta_d) {
    if (theta_d == theta_d_) return;
    theta_d_ = theta_d;
    own_ = refraction_at(m_, theta_d);
    turns_.clear();
    for (int k = 0; is_turn(m_.ellipse, k); ++k) {
      const Refraction<double> refraction = refraction_of_turn(m_, k, theta_d);
      turns_.push_back({refraction, make_caustic(refraction), {}});
    }
  }

  const Marschner<double>& m_;
  int lobe_;
  double theta_d_ = std::numeric_limits<double>::quiet_NaN();
  Refraction<double> own_{};
  std::vector<Turn> turns_;
};

bool azimuthal_means(const registry::ParameterValues& values, int lobe, std::span<const AzimuthInterval> intervals,
                     std::span<AzimuthMean> out) {
  const Marschner<double> m = prepare(registry::from_values<Parameters>(values));
  if (!has_exact_means(m) || lobe < 0) return false;
  AzimuthalMeans means(m, lobe);
  std::transform(intervals.begin(), intervals.end(), out.begin(),
                 [&](const AzimuthInterval& interval) { return means.of(interval); });
  return true;
}

double caustic_index(const registry::ParameterValues& values) {
  const Parameters parameters = registry::from_values<Parameters>(values);
  return has_one_caustic(prepare(parameters)) ? parameters.eta : 0;
}

FibreMapping from_fibre(const Fibre& fibre) {
  const double beta = std::clamp(fibre.longitudinal_deviation, 1e-3, 1.0);
  const double alpha = std::clamp(-fibre.scale_tilt, -0.17453292519943295, 0.0);
  return {
      fmt::format("eta={:.15g},sigma_a={:.15g}/{:.15g}/{:.15g},beta={:.15g},alpha={:.15g},aspect={:.15g}", fibre.eta,
                  fibre.sigma_a.x, fibre.sigma_a.y, fibre.sigma_a.z, beta, alpha, std::max(fibre.aspect, 0.5)),
      "beta is the longitudinal deviation, alpha minus the tilt of the scales, aspect that of the cross-section (TRT "
      "only); a smooth cuticle without azimuthal blur, and no medulla"};
}

// The corrected model of a round fibre with its exact caustic keeps energy up to what tilted lobes shift apart: a check
// tilts it whatever its own tilt.
constexpr std::array<Exception, 7> exceptions = {{
    {"white_furnace", "M is 2 in theta_i and 1 / cos^2 theta_d has no bound", "variant=as_published"},
    {"white_furnace", "glints add energy", "caustic=smoothed"},
    {"white_furnace", "energies of several indices are mixed", "aspect!=1"},
    {"white_furnace",
     "lobes that a tilt shifts apart take their shares at different theta_d; attenuation_angle=theta_o keeps energy",
     "attenuation_angle=theta_d"},
    {"absorbing_furnace", "as white_furnace, and a crossing absorbs by the square of its chord",
     "variant=as_published"},
    {"absorbing_furnace", "glints add energy", "caustic=smoothed"},
    {"reciprocity", "A and N belong to theta_o alone, which keeps energy; attenuation_angle=theta_d is reciprocal",
     "attenuation_angle=theta_o"},
}};

Model table() {
  return {.entry = {.kind = registry::EntryKind::model,
                    .name = "marschner",
                    .summary = "smooth fibre, circular or elliptical: R, TT and TRT with exact roots, or as printed",
                    .source = "Marschner et al. 2003; M of d'Eon et al. 2011",
                    .parameters = registry::table_of<Parameters>(),
                    .systems = system_rows,
                    .study_cases = tiers},
          .lobes = lobe_names,
          .conventions = conventions_of_shift("far", "standard deviation in theta_i"),
          .presets = pigment_presets,
          .from_fibre = from_fibre,
          .measurable = measurable,
          .exceptions = exceptions,
          .azimuthal_means = azimuthal_means,
          .caustic_index = caustic_index};
}

}  // namespace

void describe(registry::Members& members, Parameters& p) {
  members(p.eta, eta_parameter);
  members(p.sigma_a, sigma_a_parameter);
  members(p.beta, "beta", "rad", 1e-3, 1,
          "standard deviation of the R lobe in theta_i (twice the paper's beta_R, which is in theta_h)");
  members(p.alpha, "alpha", "rad", -0.17453292519943295, 0.17453292519943295,
          "shift of the R lobe in theta_h by the cuticle's scales (the paper's alpha_R)");
  members(p.variant, "variant", variants,
          "corrected: energy-conserving M, exact roots, true chord; as_published: the paper as printed");
  members(p.aspect, "aspect", "1", 0.5, 2,
          "the paper's a for an elliptical cross-section (TRT only); 1: a circle, 0.85 .. 1 in the paper");
  members(p.turns, turns_parameter);
  members(p.caustic, "caustic", caustics,
          "exact: TRT with its singularities; smoothed: the paper's N_TRT without them");
  members(p.k_g, "k_g", "1", 0, 5, "smoothed: strength of the glints (k_G), 0.5 .. 5 in the paper");
  members(p.w_c, "w_c", "rad", 0.08726646259971647, 0.5235987755982988,
          "smoothed: standard deviation of the glints in azimuth, 10 .. 25 degrees in the paper");
  members(p.delta_eta, "delta_eta", "1", 0.05, 1,
          "smoothed: range of eta' beyond 2 over which the glints fade, 0.2 .. 0.4 in the paper");
  members(p.delta_h_max, "delta_h_max", "radius", 0.05, 1,
          "smoothed: widest stretch of the fibre that feeds a glint, 0.5 in the paper");
  members(p.attenuation_angle, "attenuation_angle", attenuation_angles,
          "corrected: theta_d, the paper's, is reciprocal where alpha is 0; theta_o keeps energy with any tilt");
}

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::marschner
