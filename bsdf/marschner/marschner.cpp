#include <array>

#include <cuticle/bsdf/shared/batch.h>
#include <cuticle/core/real.h>
#include <cuticle/bsdf/marschner/marschner.glslh>

namespace cuticle::bsdf::marschner {
namespace {

constexpr std::array<std::string_view, 3> lobe_names = {"R", "TT", "TRT"};
constexpr std::array<std::string_view, 1> variants = {"corrected"};
constexpr std::array<std::string_view, 3> system_rows = {"N11", "G1", "G7"};

using registry::ParameterType;
// Defaults: the middle of the paper's ranges. Its beta_R of 5 .. 10 degrees is a width in theta_h, so 7.5 is 15 degrees
// in theta_i.
constexpr std::array<registry::Parameter, 5> parameters = {{
    {"eta", ParameterType::real, "1", 1.05, 3, "1.55", {}, "refractive index of the fibre"},
    {"sigma_a",
     ParameterType::rgb,
     "1/radius",
     0,
     100,
     "0.2",
     {},
     "absorption per fibre radius, for red, green and blue"},
    {"beta",
     ParameterType::real,
     "rad",
     1e-3,
     1,
     "0.2617993877991494",
     {},
     "standard deviation of the R lobe in theta_i (twice the paper's beta_R, which is in theta_h)"},
    {"alpha",
     ParameterType::real,
     "rad",
     -0.17453292519943295,
     0.17453292519943295,
     "-0.1308996938995747",
     {},
     "shift of the R lobe in theta_h by the cuticle's scales (the paper's alpha_R)"},
    {"variant", ParameterType::choice, "1", 0, 0, "corrected", variants,
     "corrected: energy-conserving M, exact roots, true chord"},
}};

// sigma_a from pigment: eumelanin (0.419, 0.697, 1.37) and pheomelanin (0.187, 0.4, 1.05) per unit of concentration
// (d'Eon et al. 2011, as tabulated in pbrt), concentration of eumelanin 0.3 blonde, 1.3 brown, 8 black (pbrt).
constexpr std::array<registry::StudyCase, 3> presets = {{
    {"blonde", "eta=1.55,sigma_a=0.1257/0.2091/0.411"},
    {"brown", "eta=1.55,sigma_a=0.5447/0.9061/1.781"},
    {"black", "eta=1.55,sigma_a=3.352/5.576/10.96"},
}};

void pack_lobe(const LongitudinalLobe<double>& lobe, double* out) {
  out[0] = lobe.inverse_variance;
  out[1] = lobe.norm;
  out[2] = lobe.sin_shift;
  out[3] = lobe.cos_shift;
}

Packed<double> pack_double(const registry::ParameterValues& values) {
  const Marschner<double> m =
      make_marschner<double>(values.real("eta"), values.rgb("sigma_a"), values.real("beta"), values.real("alpha"));
  Packed<double> packed{};
  pack_lobe(m.r, packed.value);
  pack_lobe(m.tt, packed.value + 4);
  pack_lobe(m.trt, packed.value + 8);
  packed.value[12] = m.glass.eta_squared;
  packed.value[13] = m.glass.eta_squared_minus_one;
  for (int c = 0; c < 3; ++c) packed.value[14 + c] = m.glass.sigma_a[c];
  return packed;
}

struct Formulas {
  static Packed<double> pack(const registry::ParameterValues& values) { return pack_double(values); }
  template <class Real>
  static Rgb<Real> evaluate(const Packed<Real>& packed, int quantity, int lobe, const EvaluationPoint<Real>& at) {
    return evaluate_packed(packed, quantity, lobe, at);
  }
};

}  // namespace

const Model& entry() {
  static const Model model{
      .entry = {.kind = registry::EntryKind::model,
                .name = "marschner",
                .summary = "smooth circular fibre: R, TT and TRT with exact roots",
                .source = "Marschner et al. 2003; M of d'Eon et al. 2011",
                .parameters = parameters,
                .systems = system_rows},
      .lobes = lobe_names,
      .conventions =
          {.field = "far",
           .cosine = "not included",
           .tilt_sign =
               "positive alpha moves the R lobe toward theta_i + theta_o > 0, the tip; the paper's is negative",
           .roughness = "standard deviation in theta_i",
           .absorption = "per fibre radius"},
      .evaluate_f32 = evaluate_points<Formulas, Single>,
      .evaluate_f64 = evaluate_points<Formulas, double>,
      .pack = pack_floats<Formulas>,
      .presets = presets};
  return model;
}

}  // namespace cuticle::bsdf::marschner
