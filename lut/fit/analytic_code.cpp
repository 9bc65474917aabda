// The text of an analytic fit: shader code and JSON.
#include <filesystem>

#include <fmt/format.h>

#include "core/file.h"
#include "core/json/json.h"
#include "lut/fit/analytic_fit.h"

namespace cuticle::lut {
namespace {

constexpr std::string_view k_functions = R"(
float cuticle_bell(float x) { return exp(-0.5 * x * x); }

float cuticle_quadratic(float a, float b, float c, float x) { return a + x * (b + x * c); }

// Bumps at phi = middle, at its mirror image, and at that a turn on.
float cuticle_bump(float phi, float height, float middle, float ln_width) {
  float inverse = exp(-ln_width);
  return exp(height) * (cuticle_bell((phi - middle) * inverse) + cuticle_bell((phi + middle) * inverse) +
                        cuticle_bell((6.2831853 - phi - middle) * inverse));
}

float cuticle_longitudinal(float theta_i, float theta_o, float width, float knee) {
  float variance = width * width;
  float cosine = abs(cos(theta_o));
  float across = cos(theta_i) - cosine;
  float along = sin(theta_i) + sin(theta_o);
  float x = cos(theta_i) * cosine / variance;
  float bessel = 1.0 / sqrt(1.0 + 6.2831853 * x * (x + 0.31830989 * knee) / (x + knee));
  return bessel * exp(-0.5 * (across * across + along * along) / variance) / (variance * (1.0 - exp(-2.0 / variance)));
}
)";

/// A number as GLSL, HLSL and C++ read it.
std::string literal(double value) {
  const std::string text = fmt::format("{:.8g}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string quadratic_call(const double* q) {
  return fmt::format("cuticle_quadratic({}, {}, {}, cos_theta_d)", literal(q[0]), literal(q[1]), literal(q[2]));
}

std::string azimuthal_code(const AnalyticLobe& lobe) {
  std::string text = fmt::format(
      "\n// phi in 0 .. pi, absorption of one colour. Error: rms {:.2g} of the rms, at most {:.2g} of the peak.\n"
      "float cuticle_N_{}(float phi, float cos_theta_d, float sigma_a) {{\n  float sum = 0.0;\n",
      lobe.n.rms, lobe.n.maximum, lobe.name);
  for (int k = 0; k < k_analytic_bumps; ++k) {
    const double* q = lobe.bumps.data() + k * k_bump_numbers;
    text += fmt::format("  sum += cuticle_bump(phi, {} - sigma_a * {},\n      {},\n      {});\n", quadratic_call(q),
                        quadratic_call(q + 3), quadratic_call(q + 6), quadratic_call(q + 9));
  }
  return text + "  return sum;\n}\n";
}

std::string longitudinal_code(const AnalyticLobe& lobe) {
  return fmt::format(
      "\n// Error: rms {:.2g} of the rms, at most {:.2g} of the peak, within 80 degrees.\n"
      "float cuticle_M_{}(float theta_i, float theta_o, float beta) {{\n"
      "  return cuticle_longitudinal(theta_i, theta_o - ({}), {} * beta, {});\n}}\n",
      lobe.m.rms, lobe.m.maximum, lobe.name, literal(lobe.shift), literal(lobe.width), literal(lobe.knee));
}

Json json_of(const AnalyticLobe& lobe) {
  return {{"name", lobe.name},
          {"bumps", lobe.bumps},
          {"width", lobe.width},
          {"shift", lobe.shift},
          {"knee", lobe.knee},
          {"n_error", {{"rms_over_rms", lobe.n.rms}, {"maximum_over_peak", lobe.n.maximum}}},
          {"m_error", {{"rms_over_rms", lobe.m.rms}, {"maximum_over_peak", lobe.m.maximum}}}};
}

}  // namespace

std::string shader_code(const AnalyticFit& fit) {
  std::string text = fmt::format(
      "// {} without textures, by cuticle bake --fit analytic: parameters {}.\n"
      "// Radians; S = M_R N_R + M_TT N_TT + M_TRT N_TRT, without the cosine; beta is the model's {}. Call it for "
      "each\n"
      "// colour with that colour's sigma_a (0 .. 2 per fibre radius). GLSL, HLSL and C++ read the same text.\n",
      fit.model->entry.name, registry::to_json(fit.values), fit.roughness);
  text += k_functions;
  for (const AnalyticLobe& lobe : fit.lobes) text += azimuthal_code(lobe) + longitudinal_code(lobe);
  text +=
      "\nfloat cuticle_S(float theta_i, float theta_o, float phi, float beta, float sigma_a) {\n"
      "  float cos_theta_d = cos(0.5 * (theta_o - theta_i));\n  float sum = 0.0;\n";
  for (const AnalyticLobe& lobe : fit.lobes)
    text += fmt::format("  sum += cuticle_M_{0}(theta_i, theta_o, beta) * cuticle_N_{0}(phi, cos_theta_d, sigma_a);\n",
                        lobe.name);
  return text + "  return sum;\n}\n";
}

std::string to_json(const AnalyticFit& fit) {
  Json json{{"schema_version", 1},
            {"model", fit.model->entry.name},
            {"parameters", Json::parse(registry::to_json(fit.values)).value()},
            {"beta", fit.roughness},
            {"lobes", Json::list()}};
  for (const AnalyticLobe& lobe : fit.lobes) json["lobes"].push_back(json_of(lobe));
  return json.dump(2) + "\n";
}

Result<void> write(const AnalyticFit& fit, const std::string& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  for (const char* name : {"analytic.glsl", "analytic.hlsl"})
    CUTICLE_TRY(write_text_file(folder + "/" + name, shader_code(fit)));
  return write_text_file(folder + "/analytic.json", to_json(fit));
}

}  // namespace cuticle::lut
