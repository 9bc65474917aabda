#include "bsdf/pigment/pigment.h"

#include <array>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/quadrature.h"

namespace cuticle::bsdf {
namespace {

constexpr std::array<PigmentTable, 2> tables = {{
    {"deon_pbrt", "d'Eon et al. 2011, as tabulated in pbrt", {0.419, 0.697, 1.37}, {0.187, 0.4, 1.05}},
    {"blender", "Blender Cycles, Principled Hair", {0.506, 0.841, 1.653}, {0.343, 0.733, 1.924}},
}};

Result<void> check_number(std::string_view name, double value, double minimum, double maximum) {
  if (value >= minimum && value <= maximum) return {};
  return bad_input(fmt::format("{} = {} is outside {} .. {}", name, value, minimum, maximum));
}

Result<void> check_rgb(std::string_view name, const glm::dvec3& value, double minimum, double maximum) {
  constexpr std::array<char, 3> components = {'r', 'g', 'b'};
  for (int c = 0; c < 3; ++c)
    CUTICLE_TRY(check_number(fmt::format("{}.{}", name, components[c]), value[c], minimum, maximum));
  return {};
}

/// The polynomial in beta_n of Chiang et al. 2016, equation 9.
double assembly_scale(double beta_n) {
  return 5.969 + beta_n * (-0.215 + beta_n * (2.532 + beta_n * (-10.73 + beta_n * (5.574 + beta_n * 0.245))));
}

Result<const registry::Parameter*> absorption_parameter(const Model& model) {
  for (const registry::Parameter& parameter : model.entry.parameters)
    if (parameter.name == "sigma_a" && parameter.type == registry::ParameterType::rgb) return &parameter;
  return usage_error(fmt::format("model {} has no sigma_a, so no colour can be inverted on it", model.entry.name));
}

Result<void> check_reachable(const glm::dvec3& color, const glm::dvec3& darkest, const glm::dvec3& lightest) {
  constexpr std::array<char, 3> components = {'r', 'g', 'b'};
  for (int c = 0; c < 3; ++c)
    if (!(color[c] >= darkest[c] && color[c] <= lightest[c]))
      return bad_input(fmt::format("color.{} = {} is outside the fibre's albedos {:.6g} .. {:.6g}", components[c],
                                   color[c], darkest[c], lightest[c]),
                       "the assembly inversion takes any colour");
  return {};
}

}  // namespace

std::span<const PigmentTable> pigment_tables() { return tables; }

Result<PigmentTable> find_pigment_table(std::string_view name) {
  std::vector<std::string_view> known;
  for (const PigmentTable& table : tables) {
    if (table.name == name) return table;
    known.push_back(table.name);
  }
  const std::string near = registry::nearest_name(name, known);
  return usage_error(fmt::format("pigment table '{}' is not one of {}", name, fmt::join(known, ", ")),
                     near.empty() ? std::string() : fmt::format("did you mean {}?", near));
}

Result<glm::dvec3> absorption_of_pigments(const PigmentTable& table, double eumelanin, double pheomelanin) {
  CUTICLE_TRY(check_number("eumelanin", eumelanin, 0, 100));
  CUTICLE_TRY(check_number("pheomelanin", pheomelanin, 0, 100));
  return table.eumelanin * eumelanin + table.pheomelanin * pheomelanin;
}

Result<Melanin> melanin_concentrations(double melanin, double redness) {
  CUTICLE_TRY(check_number("melanin", melanin, 0, 1));
  CUTICLE_TRY(check_number("redness", redness, 0, 1));
  const double together = -std::log(std::max(1 - melanin, 1e-4));
  return Melanin{together * (1 - redness), together * redness};
}

Result<glm::dvec3> absorption_of_assembly(const glm::dvec3& color, double beta_n) {
  CUTICLE_TRY(check_rgb("color", color, 1e-3, 1));
  CUTICLE_TRY(check_number("beta_n", beta_n, 0, 1));
  glm::dvec3 sigma_a(0);
  for (int c = 0; c < 3; ++c) sigma_a[c] = std::pow(std::log(color[c]) / assembly_scale(beta_n), 2);
  return sigma_a;
}

Result<glm::dvec3> color_of_assembly(const glm::dvec3& sigma_a, double beta_n) {
  CUTICLE_TRY(check_rgb("sigma_a", sigma_a, 0, 100));
  CUTICLE_TRY(check_number("beta_n", beta_n, 0, 1));
  glm::dvec3 color(0);
  for (int c = 0; c < 3; ++c) color[c] = std::exp(-std::sqrt(sigma_a[c]) * assembly_scale(beta_n));
  return color;
}

Result<glm::dvec3> color_of_fibre(const Model& model, const registry::ParameterValues& values, double theta_o) {
  const bool near = model.near_field && model.near_field(values);
  const QuadratureRule rule = near ? gauss_legendre(32) : QuadratureRule{{0}, {2}};
  std::vector<Point> points;
  for (double h : rule.nodes) points.push_back({.theta_o = theta_o, .h = h});
  std::vector<glm::dvec3> albedos(points.size());
  CUTICLE_TRY(evaluate(model, values, Precision::f64, {Quantity::albedo, -1, points}, albedos));
  glm::dvec3 mean(0);
  for (std::size_t k = 0; k < albedos.size(); ++k) mean += 0.5 * rule.weights[k] * albedos[k];
  return mean;
}

Result<glm::dvec3> absorption_of_fibre(const Model& model, const registry::ParameterValues& values,
                                       const glm::dvec3& color, double theta_o) {
  CUTICLE_ASSIGN(const registry::Parameter* parameter, absorption_parameter(model));
  registry::ParameterValues trial = values;
  const auto albedo = [&](const glm::dvec3& root) {
    trial.set("sigma_a", root * root);
    return color_of_fibre(model, trial, theta_o);
  };
  glm::dvec3 low(0), high(std::sqrt(parameter->maximum));
  CUTICLE_ASSIGN(const glm::dvec3 lightest, albedo(low));
  CUTICLE_ASSIGN(const glm::dvec3 darkest, albedo(high));
  CUTICLE_TRY(check_reachable(color, darkest, lightest));
  for (int step = 0; step < 50; ++step) {
    const glm::dvec3 middle = 0.5 * (low + high);
    CUTICLE_ASSIGN(const glm::dvec3 found, albedo(middle));
    for (int c = 0; c < 3; ++c) (found[c] > color[c] ? low : high)[c] = middle[c];
  }
  return 0.25 * (low + high) * (low + high);
}

}  // namespace cuticle::bsdf
