#pragma once
// A model's M and N without textures: a few Gaussians for each lobe, as shader code with its measured error.
#include <array>
#include <string>
#include <vector>

#include "bsdf/model.h"
#include "core/progress.h"

namespace cuticle::lut {

/// rms and maximum of the error over the rms and the peak of the exact values, off the points that were fitted.
struct AnalyticError {
  double rms = 0, maximum = 0;
};

inline constexpr int k_analytic_bumps = 2;
inline constexpr int k_bump_numbers = 12;

/// One lobe. N(phi, c, s) for c = cos theta_d and absorption s is a sum of bumps exp(a - l s) (g(phi - m) + g(phi + m)
/// + g(2 pi - phi - m)), g(x) = exp(-x^2 / (2 w^2)); each bump has a, l, m and ln w as quadratics in c. M(theta_i,
/// theta_o, beta) is d'Eon's with width beta times `width`, its peak at theta_i + theta_o = shift [rad] and the Bessel
/// function as 1 / sqrt(1 + 2 pi x (x + knee / pi) / (x + knee)).
struct AnalyticLobe {
  std::string name;
  std::array<double, k_analytic_bumps * k_bump_numbers> bumps{};
  double width = 1, shift = 0, knee = 1;
  AnalyticError n, m;
};
struct AnalyticFit {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  std::string roughness;  ///< the model's parameter that M takes as beta
  std::vector<AnalyticLobe> lobes;
};

/// Fits every lobe of a far-field model (Ceres) for phi, cos theta_d in 0.1 .. 1, absorption 0 .. 2 and half to twice
/// the model's beta; its other parameters keep the values given. Errors: usage, for a model without R, TT, TRT,
/// sigma_a and beta or beta_m, or in its near field.
Result<AnalyticFit> fit_analytic(const bsdf::Model& model, const registry::ParameterValues& values, Progress& progress);

/// M and N of a lobe as the shader code computes them; radians.
double analytic_n(const AnalyticLobe& lobe, double phi, double cos_theta_d, double sigma_a);
double analytic_m(const AnalyticLobe& lobe, double theta_i, double theta_o, double beta);

/// Functions cuticle_N_R, cuticle_M_R, ..., cuticle_S over float, in what GLSL, HLSL and C++ have in common.
std::string shader_code(const AnalyticFit& fit);
/// Coefficients, errors and parameters as JSON text.
std::string to_json(const AnalyticFit& fit);
/// Writes analytic.glsl, analytic.hlsl (the same text) and analytic.json into the folder. Error: bad_input naming the
/// file.
Result<void> write(const AnalyticFit& fit, const std::string& folder);

}  // namespace cuticle::lut
