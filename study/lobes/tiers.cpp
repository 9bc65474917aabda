// Error and work of a model's tiers.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <random>

#include <fmt/core.h>

#include "study/lobes/lobes_study.h"

namespace cuticle::study {
namespace {

using Values = std::vector<glm::dvec3>;
using bsdf::Precision;

/// Directions that fill the sphere evenly, azimuths and offsets evenly.
std::vector<bsdf::Point> random_points(std::size_t count) {
  std::mt19937 generator(20260101);
  std::uniform_real_distribution<double> even(-1, 1);
  std::vector<bsdf::Point> points(count);
  for (bsdf::Point& point : points)
    point = {.theta_i = std::asin(even(generator)),
             .theta_o = std::asin(even(generator)),
             .phi = 3.14159 * even(generator),
             .h = even(generator)};
  return points;
}

constexpr double k_max_rounds = 3e7;  ///< loop rounds of a reference, all directions together
constexpr std::size_t k_fewest_points = 16;

/// How many directions: fewer where the model walks many paths.
std::size_t points_of(const bsdf::Model& model, const registry::ParameterValues& values, std::size_t most) {
  const double rounds = model.loop_rounds ? double(model.loop_rounds(values, bsdf::Quantity::S)) : 0;
  if (rounds * double(most) <= k_max_rounds) return most;
  return std::min(most, std::max(k_fewest_points, std::size_t(k_max_rounds / rounds)));
}

/// What a field's tiers are compared with.
struct Reference {
  std::string tier;
  std::vector<bsdf::Point> points;
  Values values;
};
using SharedReference = std::shared_ptr<const Reference>;

/// |S / reference - 1| of green light where the reference is above 1e-6 of its largest value; elsewhere NaN.
std::vector<double> relative_errors(const Values& values, const Values& reference) {
  double largest = 0;
  for (const glm::dvec3& value : reference) largest = std::max(largest, value.y);
  std::vector<double> errors(values.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (reference[i].y > 1e-6 * largest) errors[i] = values[i].y / reference[i].y - 1;
  return errors;
}

/// A tier in a precision, of one model and field.
struct Case {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  Precision precision = Precision::f64;
  SharedReference reference;
};

Result<Measured> errors_of(const Case& at) {
  Values out(at.reference->points.size());
  CUTICLE_TRY(bsdf::evaluate(*at.model, at.values, at.precision, {bsdf::Quantity::S, -1, at.reference->points}, out));
  return Measured{{relative_errors(out, at.reference->values)}};
}

constexpr std::size_t k_timed_points = 64;
constexpr double k_timed_rounds = 5e6;

/// One thread over the first directions.
Work work_of(const Case& at) {
  const double rounds = at.model->loop_rounds ? double(at.model->loop_rounds(at.values, bsdf::Quantity::S)) : 0;
  const double most = rounds > 0 ? std::max(1.0, k_timed_rounds / rounds) : 1e9;
  const std::size_t count = std::min({k_timed_points, at.reference->points.size(), std::size_t(most)});
  const auto out = std::make_shared<Values>(count);
  const auto evaluate = at.precision == Precision::f64 ? at.model->evaluate_f64 : at.model->evaluate_f32;
  return {{},
          [at, out, evaluate, count]() -> Result<void> {
            evaluate(at.values, {bsdf::Quantity::S, -1, std::span(at.reference->points).first(count)}, *out);
            return {};
          },
          double(count)};
}

Result<SharedReference> make_reference(const bsdf::Model& model, const LobesTier& tier,
                                       const registry::ParameterValues& values, std::size_t most) {
  Reference reference{tier.name, random_points(most), {}};
  reference.points.resize(points_of(model, values, most));
  reference.values.resize(reference.points.size());
  CUTICLE_TRY(
      bsdf::evaluate(model, values, Precision::f64, {bsdf::Quantity::S, -1, reference.points}, reference.values));
  return SharedReference(std::make_shared<const Reference>(std::move(reference)));
}

Group make_group(const bsdf::Model& model, bool near, const Reference& reference) {
  const std::string field = near ? "near field" : "far field";
  return {.name = fmt::format("{}, {}", model.entry.name, field),
          .title = fmt::format("{}, {}: tiers and precisions", model.entry.name, field),
          .truth =
              fmt::format("the tier '{}' in double at {} random directions, where S is above 1e-6 of its largest value",
                          reference.tier, reference.points.size()),
          .metrics = {{"S", "relative error of S"}},
          .item = "direction"};
}

Point make_point(const Case& at, const LobesTier& tier) {
  return {at.precision == Precision::f64 ? "double" : "float",
          {{"tier", tier.name}},
          [at] { return errors_of(at); },
          work_of(at)};
}

}  // namespace

std::vector<LobesTier> tiers_of(const bsdf::Model& model, const std::string& settings) {
  std::vector<LobesTier> tiers;
  for (const registry::StudyCase& tier : model.entry.study_cases)
    tiers.push_back({std::string(tier.name), fmt::format("{},{}", settings, tier.settings)});
  if (tiers.empty()) tiers.push_back({"default", settings});
  return tiers;
}

std::string finest_settings(const bsdf::Model& model, const std::string& settings) {
  return tiers_of(model, settings).back().settings;
}

std::string shown_settings(const bsdf::Model& model, const std::string& settings, std::size_t points) {
  const std::string finest = finest_settings(model, settings);
  const auto values = bsdf::parse_settings(model, "", finest);
  const bool is_slow = values && model.loop_rounds &&
                       double(model.loop_rounds(*values, bsdf::Quantity::S)) * double(points) > 10 * k_max_rounds;
  return is_slow ? settings : finest;
}

Result<std::vector<Group>> tier_groups(const bsdf::Model& model, const std::string& settings,
                                       const LobesRequest& request) {
  const std::vector<LobesTier> tiers = tiers_of(model, settings);
  std::map<bool, std::pair<SharedReference, Group>> fields;
  for (auto tier = tiers.rbegin(); tier != tiers.rend(); ++tier) {
    CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", tier->settings));
    const bool near = model.near_field && model.near_field(values);
    auto& [reference, group] = fields[near];
    if (!reference) {
      CUTICLE_ASSIGN(reference, make_reference(model, *tier, values, request.points));
      group = make_group(model, near, *reference);
    }
    for (const Precision precision : {Precision::f64, Precision::f32})
      group.points.push_back(make_point({&model, values, precision, reference}, *tier));
  }
  std::vector<Group> groups;
  for (auto& [near, field] : fields) groups.push_back(std::move(field.second));
  return groups;
}

}  // namespace cuticle::study
