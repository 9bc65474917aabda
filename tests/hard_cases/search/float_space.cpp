// S of every model but `huang` in float against double, beyond what the rounding of its inputs makes of it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bsdf/model.h"
#include "tests/hard_cases/model_points.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

/// A model; what bounds the difference at the places of every run, and with the sweeps: at least four times the largest
/// that some thousand climbs found, where peaks and jumps are beside what float can tell and tolerances below its
/// rounding.
struct FloatModel {
  const char* model;
  double usual, hardest;
  int climbs;
  double at_most() const { return is_sweep() ? hardest : usual; }
};
constexpr FloatModel k_float_models[] = {{"marschner", 0.16, 1.8, 40},    {"kajiya_kay", 1.2e-5, 5e-4, 40},
                                         {"karis", 1e-4, 1e-3, 40},       {"scheuermann", 4e-5, 0.08, 40},
                                         {"hairworks", 1.3e-5, 5e-3, 40}, {"chiang", 0.03, 0.7, 10},
                                         {"deon", 4e-4, 2.5e-3, 10},      {"yan_fur", 0.03, 0.03, 2}};

constexpr std::size_t k_float_angles = 5;

const bsdf::Model& model_of(const FloatModel& searched) { return **bsdf::find_model(searched.model); }

Json float_inputs(const FloatModel& searched, const Place& place) {
  Coordinates at(place);
  const std::string set = at.settings(model_of(searched).entry.parameters);
  Json inputs{{"model", searched.model}, {"set", set}, {"quantity", "S"}};
  for (const char* angle : {"theta_i_deg", "theta_o_deg"}) inputs[angle] = at.between(-90, 90);
  for (const char* angle : {"phi_deg", "phi_o_deg"}) inputs[angle] = at.between(-180, 180);
  inputs["h"] = at.between(-1, 1);
  return inputs;
}

/// S at a place; false where it is refused, a rule between parameters.
bool evaluate(const Json& inputs, bsdf::Precision precision, glm::dvec3& value) {
  const bsdf::Model& model = **bsdf::find_model(inputs.at("model").text());
  const auto values = registry::parse_assignments(model.entry.parameters, inputs.at("set").text());
  const std::vector<bsdf::Point> points = points_from(inputs);
  return values && bsdf::evaluate(model, *values, precision, {bsdf::Quantity::S, -1, points}, {&value, 1});
}

/// Whether a small step of this coordinate is a small step of an input.
bool is_continuous(const FloatModel& searched, std::size_t coordinate) {
  const registry::ParameterTable table = model_of(searched).entry.parameters;
  if (coordinate >= table.size()) return true;
  return table[coordinate].type == registry::ParameterType::real ||
         table[coordinate].type == registry::ParameterType::rgb;
}

/// How far S moves where the inputs do by some roundings of a float: beside an infinite peak or a jump float cannot
/// know better.
glm::dvec3 conditioning(const FloatModel& searched, const Place& place, const glm::dvec3& exact) {
  constexpr double k_rounding = 2.4e-7;
  glm::dvec3 moved(0);
  for (std::size_t k = 0; k < place.size(); ++k)
    for (double sign : {-1.0, 1.0}) {
      if (!is_continuous(searched, k)) continue;
      Place near = place;
      near[k] += sign * k_rounding;
      glm::dvec3 value = exact;
      if (evaluate(float_inputs(searched, near), bsdf::Precision::f64, value))
        moved = glm::max(moved, glm::abs(value - exact));
    }
  return moved;
}

/// What float adds to the rounding of the inputs: |float - double| over 1 + |double| + twice that, the worst channel;
/// endless where a value is not finite or below 0.
double float_error(const FloatModel& searched, const Place& place) {
  const Json inputs = float_inputs(searched, place);
  glm::dvec3 single(0), exact(0);
  if (!evaluate(inputs, bsdf::Precision::f32, single) || !evaluate(inputs, bsdf::Precision::f64, exact)) return 0;
  const auto worst_over = [&](const glm::dvec3& moved) {
    const glm::dvec3 off = glm::abs(single - exact) / (1.0 + glm::abs(exact) + 2.0 * moved);
    return std::max({off.x, off.y, off.z});
  };
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(single[c]) || !std::isfinite(exact[c]) || single[c] < 0 || exact[c] < 0)
      return std::numeric_limits<double>::infinity();
  const double raw = worst_over(glm::dvec3(0));
  return raw < 1e-6 ? raw : worst_over(conditioning(searched, place, exact));
}

}  // namespace

std::vector<Space> float_spaces() {
  std::vector<Space> all;
  for (const FloatModel& searched : k_float_models)
    all.push_back({.name = std::string("float_") + searched.model,
                   .size = model_of(searched).entry.parameters.size() + k_float_angles,
                   .case_at =
                       [&searched](const Place& place) {
                         return Json{{"subject", "model"},
                                     {"inputs", float_inputs(searched, place)},
                                     {"expect", Json{{"agree", Json{{"f32", searched.at_most()}}}}}};
                       },
                   .climbs = searched.climbs,
                   .at_most = searched.at_most(),
                   .error = [&searched](const Place& place) { return float_error(searched, place); }});
  return all;
}

}  // namespace cuticle::hard_cases::search
