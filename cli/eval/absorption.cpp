#include "cli/eval/absorption.h"

#include <algorithm>

#include <fmt/core.h>

#include "bsdf/pigment/pigment.h"
#include "cli/command.h"
#include "core/registry/find_value.h"

namespace cuticle::cli {
namespace {

/// "name:a/b/c" in its parts.
struct Named {
  std::string name;
  std::vector<double> numbers;
};
Result<Named> parse_named(const std::string& option, const std::string& text, std::size_t count, const char* example) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  std::string list = text.substr(std::min(colon + 1, text.size()));
  std::replace(list.begin(), list.end(), '/', ',');
  CUTICLE_ASSIGN(std::vector<double> numbers, parse_numbers(option, list));
  if (numbers.size() != count)
    return usage_error(fmt::format("{}: '{}' is not a name and {} numbers", option, text, count), example);
  return Named{text.substr(0, colon), std::move(numbers)};
}

Result<glm::dvec3> from_pigments(const std::string& text) {
  CUTICLE_ASSIGN(const Named named, parse_named("--pigments", text, 2, "--pigments deon_pbrt:1.3/0"));
  CUTICLE_ASSIGN(const bsdf::PigmentTable table, bsdf::find_pigment_table(named.name));
  return bsdf::absorption_of_pigments(table, named.numbers[0], named.numbers[1]);
}

Result<glm::dvec3> from_color(const std::string& text, const bsdf::Model& model,
                              const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Named named, parse_named("--color", text, 3, "--color assembly:0.6/0.4/0.2"));
  const glm::dvec3 color(named.numbers[0], named.numbers[1], named.numbers[2]);
  if (named.name == "fibre") return bsdf::absorption_of_fibre(model, values, color);
  if (named.name == "assembly")
    return bsdf::absorption_of_assembly(color, registry::find_value<double>(values, "beta_n").value_or(0.3));
  return usage_error(fmt::format("--color: meaning '{}' is not one of assembly, fibre", named.name),
                     "--color assembly:0.6/0.4/0.2");
}

}  // namespace

Result<void> apply_absorption(const AbsorptionRequest& request, const bsdf::Model& model,
                              registry::ParameterValues& values) {
  if (request.pigments.empty() && request.color.empty()) return {};
  if (!request.pigments.empty() && !request.color.empty())
    return usage_error("--pigments and --color exclude each other");
  const Result<const registry::Parameter*> parameter = registry::find_parameter(model.entry.parameters, "sigma_a");
  if (!parameter)
    return usage_error(fmt::format("model {} has no sigma_a for --pigments or --color", model.entry.name));
  CUTICLE_ASSIGN(const glm::dvec3 sigma_a,
                 request.color.empty() ? from_pigments(request.pigments) : from_color(request.color, model, values));
  const double largest = std::max({sigma_a.x, sigma_a.y, sigma_a.z});
  if (largest > (*parameter)->maximum)
    return bad_input(fmt::format("sigma_a = {} is outside 0 .. {} 1/radius", largest, (*parameter)->maximum));
  values.set("sigma_a", sigma_a);
  return {};
}

}  // namespace cuticle::cli
