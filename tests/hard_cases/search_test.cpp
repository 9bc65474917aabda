// Looks for hard cases that nobody has thought of: climbs the difference between float and double over parameters and
// angles of every closed-form model, from seeded beginnings. What it finds beyond the bound is made simple and printed
// as a case for the catalogue. With the sweeps for half an hour (scripts/test.sh --full), else for some seconds.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "core/random.h"

namespace cuticle::hard_cases::search_test {
namespace {

constexpr double k_half_turn = 3.14159265358979;

/// A model and what bounds error_at: four times the largest that 300 climbs found.
struct Searched {
  const char* model;
  double at_most;
};
constexpr Searched k_searched[] = {{"marschner", 0.16},   {"kajiya_kay", 1.2e-5}, {"karis", 1e-4},
                                   {"scheuermann", 8e-6}, {"hairworks", 1.3e-5},  {"chiang", 0.03}};

/// Where a model is asked: coordinates of a cube of side 1, parameters first, then theta_i, theta_o, phi, h, phi_o.
class Place {
 public:
  explicit Place(const bsdf::Model& model) : model_(&model) {
    for (const registry::Parameter& parameter : model.entry.parameters)
      if (parameter.type == registry::ParameterType::real && parameter.maximum > parameter.minimum)
        varied_.push_back(&parameter);
    at_.assign(varied_.size() + k_angles, 0.5);
  }

  std::size_t size() const { return at_.size(); }
  double& operator[](std::size_t k) { return at_[k]; }
  double operator[](std::size_t k) const { return at_[k]; }

  registry::ParameterValues values() const {
    registry::ParameterValues values = registry::default_values(model_->entry.parameters);
    for (std::size_t k = 0; k < varied_.size(); ++k) values.set(varied_[k]->name, value_of(*varied_[k], at_[k]));
    return values;
  }

  bsdf::Point point() const {
    const auto angle = [&](std::size_t k, double least, double most) {
      return least + (most - least) * at_[varied_.size() + k];
    };
    return {.theta_i = angle(0, -k_half_turn / 2, k_half_turn / 2),
            .theta_o = angle(1, -k_half_turn / 2, k_half_turn / 2),
            .phi = angle(2, -k_half_turn, k_half_turn),
            .h = angle(3, -1, 1),
            .phi_o = angle(4, -k_half_turn, k_half_turn)};
  }

  /// As a case of the catalogue.
  std::string text(double error) const {
    std::string set;
    for (std::size_t k = 0; k < varied_.size(); ++k)
      if (at_[k] != 0.5)
        set += fmt::format("{}{}={:.9g}", set.empty() ? "" : ",", varied_[k]->name, value_of(*varied_[k], at_[k]));
    const bsdf::Point p = point();
    const double degrees = 180 / k_half_turn;
    return fmt::format(
        R"({{"id": "found-{}", "subject": "model", "why": "found by search: float and double differ by {:.3g}", "inputs": {{"model": "{}", "set": "{}", "quantity": "S", "theta_i_deg": {:.9g}, "theta_o_deg": {:.9g}, "phi_deg": {:.9g}, "h": {:.9g}, "phi_o_deg": {:.9g}}}, "expect": {{"agree": {{"f32": 1e-4}}}}}})",
        model_->entry.name, error, model_->entry.name, set, p.theta_i * degrees, p.theta_o * degrees, p.phi * degrees,
        p.h, p.phi_o * degrees);
  }

 private:
  static constexpr std::size_t k_angles = 5;

  /// In the middle the default; towards 0 and 1 the ends of the range, by factors where it spans many.
  static double value_of(const registry::Parameter& parameter, double at) {
    const double usual = std::strtod(std::string(parameter.default_text).c_str(), nullptr);
    const double end = at < 0.5 ? parameter.minimum : parameter.maximum, share = std::abs(2 * at - 1);
    if (usual > 0 && end > 0 && std::abs(std::log(end / usual)) > 3)
      return std::clamp(usual * std::pow(end / usual, share), parameter.minimum, parameter.maximum);
    return std::clamp(usual + (end - usual) * share, parameter.minimum, parameter.maximum);
  }

  const bsdf::Model* model_;
  std::vector<const registry::Parameter*> varied_;
  std::vector<double> at_;
};

glm::dvec3 exact_at(const bsdf::Model& model, const Place& place) {
  const bsdf::Point point = place.point();
  glm::dvec3 value(0);
  (void)bsdf::evaluate(model, place.values(), bsdf::Precision::f64, {bsdf::Quantity::S, -1, {&point, 1}}, {&value, 1});
  return value;
}

/// How far S moves where the inputs do by a float's rounding: beside an infinite peak float cannot know better.
glm::dvec3 conditioning(const bsdf::Model& model, const Place& place, const glm::dvec3& exact) {
  constexpr double k_rounding = 6e-8;
  glm::dvec3 moved(0);
  for (std::size_t k = 0; k < place.size(); ++k)
    for (double sign : {-1.0, 1.0}) {
      Place near = place;
      near[k] += sign * k_rounding;
      moved = glm::max(moved, glm::abs(exact_at(model, near) - exact));
    }
  return moved;
}

/// What float adds to the rounding of the inputs: |float - double| over 1 + |double| + 8 times that, the worst channel;
/// endless where a value is not finite or below 0.
double error_at(const bsdf::Model& model, const Place& place) {
  const bsdf::Point point = place.point();
  glm::dvec3 single(0), exact(0);
  const registry::ParameterValues values = place.values();
  const bsdf::Request request{bsdf::Quantity::S, -1, {&point, 1}};
  const auto a = bsdf::evaluate(model, values, bsdf::Precision::f32, request, {&single, 1});
  const auto b = bsdf::evaluate(model, values, bsdf::Precision::f64, request, {&exact, 1});
  if (!a || !b) return 0;  // refused alike: a rule between parameters
  const auto worst_over = [&](const glm::dvec3& moved) {
    const glm::dvec3 off = glm::abs(single - exact) / (1.0 + glm::abs(exact) + 8.0 * moved);
    return std::max({off.x, off.y, off.z});
  };
  for (int c = 0; c < 3; ++c)
    if (!std::isfinite(single[c]) || !std::isfinite(exact[c]) || single[c] < 0 || exact[c] < 0) return INFINITY;
  const double raw = worst_over(glm::dvec3(0));
  return raw < 1e-6 ? raw : worst_over(conditioning(model, place, exact));
}

struct Found {
  Place place;
  double error;
};

double fold(double x) { return x < 0 ? -x : x > 1 ? 2 - x : x; }

/// From a beginning by chance up the error: steps along some coordinates, which shrink where none goes up.
Found climb(const bsdf::Model& model, RandomStream& chance, int steps) {
  Found best{Place(model), 0};
  for (std::size_t k = 0; k < best.place.size(); ++k) {
    const double kind = chance.next_unit();
    best.place[k] = kind < 0.3 ? 0.5 : kind < 0.4 ? 0 : kind < 0.5 ? 1 : chance.next_unit();
  }
  best.error = error_at(model, best.place);
  double reach = 0.3;
  for (int step = 0; step < steps && reach > 1e-7; ++step) {
    Found next = best;
    for (std::size_t k = 0; k < next.place.size(); ++k)
      if (chance.next_unit() < 0.4) next.place[k] = fold(next.place[k] + reach * (2 * chance.next_unit() - 1));
    next.error = error_at(model, next.place);
    if (next.error > best.error)
      best = next;
    else
      reach *= 0.93;
  }
  return best;
}

/// Coordinates in the middle, which mean defaults, as far as the error stays above the bound.
Found simple(const bsdf::Model& model, Found found, double bound) {
  for (std::size_t k = 0; k < found.place.size(); ++k) {
    Found next = found;
    next.place[k] = 0.5;
    next.error = error_at(model, next.place);
    if (next.error > bound) found = next;
  }
  return found;
}

class Search : public testing::TestWithParam<Searched> {};

TEST_P(Search, ClimbingTheErrorOfFloat_StaysBelowWhatWasFound) {
  const bsdf::Model& model = **bsdf::find_model(GetParam().model);
  const int climbs = std::getenv("CUTICLE_SWEEPS") ? 10000 : 60;
  RandomStream chance(20261126, 0);
  Found worst{Place(model), 0};
  for (int k = 0; k < climbs; ++k) {
    const Found found = climb(model, chance, 120);
    if (found.error > worst.error) worst = found;
    if (std::isinf(worst.error)) break;
  }
  std::printf("%s: float off by %.3g at most: %s\n", GetParam().model, worst.error,
              worst.place.text(worst.error).c_str());
  if (worst.error <= GetParam().at_most) return;
  worst = simple(model, worst, GetParam().at_most);
  ADD_FAILURE() << "a hard case that the catalogue does not have:\n" << worst.place.text(worst.error);
}
INSTANTIATE_TEST_SUITE_P(Models, Search, testing::ValuesIn(k_searched),
                         [](const auto& tested) { return std::string(tested.param.model); });

}  // namespace
}  // namespace cuticle::hard_cases::search_test
