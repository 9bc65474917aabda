#include "lut/fit/gradients.h"

#include "lut/fit/detail/tangents.h"

namespace cuticle::lut {
namespace {

std::vector<std::string> all_names(const bsdf::Model& model) {
  std::vector<std::string> names;
  for (const registry::Parameter& parameter : model.entry.parameters)
    if (parameter.type == registry::ParameterType::real || parameter.type == registry::ParameterType::rgb)
      names.emplace_back(parameter.name);
  return names;
}

}  // namespace

Result<Gradients> evaluate_gradients(const bsdf::Model& model, const registry::ParameterValues& values,
                                     std::vector<std::string> names, const bsdf::Request& request) {
  if (request.quantity > bsdf::Quantity::A)
    return usage_error("gradients are those of S, M, N or A", "eval gives the other quantities");
  CUTICLE_TRY(bsdf::check_request(model, request, request.points.size()));
  CUTICLE_ASSIGN(const JetModel* jets, find_jet_model(model));
  if (names.empty()) names = all_names(model);
  CUTICLE_ASSIGN(const std::vector<FreeParameter> free, free_parameters(model, names, false));
  Measurements rows;
  rows.quantity = request.quantity;
  for (const bsdf::Point& point : request.points) rows.rows.push_back({.point = point, .lobe = request.lobe});
  Tangents tangents = evaluate_tangents(*jets, values, free, rows);
  Gradients result{{}, std::move(tangents.values), std::move(tangents.gradients)};
  for (const FreeParameter& parameter : free) result.names.push_back(parameter.name);
  return result;
}

}  // namespace cuticle::lut
