// Every quantity of every model over all parameters and directions, its poles among them: finite and not negative in
// double and float. And the albedo of models that keep energy: no more light leaves than came.
#include <algorithm>
#include <array>

#include "bsdf/model.h"
#include "tests/hard_cases/model_points.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr std::array<const char*, 8> k_quantities = {"S", "M", "N", "A", "albedo", "pdf", "error", "sample"};
constexpr std::size_t k_quantity_lobe_angles_and_number = 9;
/// "sample" gives weights and densities, which grow without bound where lobes become narrow.
constexpr double k_largest_of_model = 1e38;

Json law_case(const bsdf::Model& model, const Place& place) {
  Coordinates at(place);
  Json inputs{{"model", model.entry.name}, {"set", at.settings(model.entry.parameters)}};
  inputs["quantity"] = k_quantities[at.below(k_quantities.size())];
  const std::size_t lobe = at.below(model.lobes.size() + 1);
  inputs["lobe"] = lobe == model.lobes.size() ? std::string_view("sum") : model.lobes[lobe];
  for (const char* angle : {"theta_i_deg", "theta_o_deg", "theta_d_deg"}) inputs[angle] = at.between(-90, 90);
  for (const char* angle : {"phi_deg", "phi_o_deg"}) inputs[angle] = at.between(-180, 180);
  inputs["h"] = at.between(-1, 1);
  inputs["u"] = std::min(at.next(), 0.9999999999999999);
  return Json{{"subject", "model"},
              {"inputs", std::move(inputs)},
              {"expect", Json{{"bounds", Json::list({0, k_largest_of_model})}}}};
}

/// By attenuation at theta_o, the default, models keep energy (at theta_d they are reciprocal instead), and within the
/// tolerance of their integrals.
constexpr std::string_view k_kept[] = {"attenuation_angle", "azimuthal_tolerance", "tolerance"};

/// A model that keeps energy, and the largest albedo that it may have: what was measured, its quadrature's error.
struct Conserving {
  const char* model;
  double at_most;
  int climbs;
};
constexpr Conserving k_conserving[] = {{"chiang", 1.001, 10}, {"deon", 1.001, 4}, {"yan_fur", 1.001, 4}};

constexpr std::size_t k_albedo_angles = 3;

Json albedo_inputs(const Conserving& conserving, const Place& place) {
  Coordinates at(place);
  const bsdf::Model& model = **bsdf::find_model(conserving.model);
  Json inputs{
      {"model", conserving.model}, {"set", at.settings(model.entry.parameters, k_kept)}, {"quantity", "albedo"}};
  inputs["theta_o_deg"] = at.between(-89.9, 89.9);
  inputs["h"] = at.between(-1, 1);
  inputs["phi_o_deg"] = at.between(-180, 180);
  return inputs;
}

double albedo(const Conserving& conserving, const Place& place) {
  const Json inputs = albedo_inputs(conserving, place);
  const bsdf::Model& model = **bsdf::find_model(conserving.model);
  const auto values = registry::parse_assignments(model.entry.parameters, inputs.at("set").text());
  const std::vector<bsdf::Point> points = points_from(inputs);
  glm::dvec3 value(0);
  if (!values ||
      !bsdf::evaluate(model, *values, bsdf::Precision::f64, {bsdf::Quantity::albedo, -1, points}, {&value, 1}))
    return 0;
  return std::max({value.x, value.y, value.z});
}

Space albedo_space(const Conserving& conserving) {
  return {.name = std::string("albedo_") + conserving.model,
          .size = (*bsdf::find_model(conserving.model))->entry.parameters.size() + k_albedo_angles,
          .case_at =
              [&conserving](const Place& place) {
                return Json{{"subject", "model"},
                            {"inputs", albedo_inputs(conserving, place)},
                            {"expect", Json{{"bounds", Json::list({0, conserving.at_most})}}}};
              },
          .climbs = conserving.climbs,
          .at_most = conserving.at_most,
          .error = [&conserving](const Place& place) { return albedo(conserving, place); }};
}

}  // namespace

std::vector<Space> model_spaces() {
  std::vector<Space> all;
  for (const bsdf::Model* model : bsdf::models())
    all.push_back({.name = "model_" + std::string(model->entry.name),
                   .size = model->entry.parameters.size() + k_quantity_lobe_angles_and_number,
                   .case_at = [model](const Place& place) { return law_case(*model, place); },
                   .climbs = model->entry.name == "huang" ? 1 : 10});
  for (const Conserving& conserving : k_conserving) all.push_back(albedo_space(conserving));
  return all;
}

}  // namespace cuticle::hard_cases::search
