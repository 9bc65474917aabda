// Error and time of a model's tiers.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>

#include <fmt/core.h>

#include "study/lobes/lobes_study.h"

namespace cuticle::study {
namespace {

using Values = std::vector<glm::dvec3>;

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

struct Tier {
  std::string name, settings;
};
std::vector<Tier> tiers_of(const bsdf::Model& model, const std::string& settings) {
  std::vector<Tier> tiers;
  for (const registry::StudyCase& tier : model.entry.study_cases)
    tiers.push_back({std::string(tier.name), fmt::format("{},{}", settings, tier.settings)});
  if (tiers.empty()) tiers.push_back({"default", settings});
  return tiers;
}

using Evaluate = void (*)(const registry::ParameterValues&, const bsdf::Request&, std::span<glm::dvec3>);

Evaluate evaluate_of(const bsdf::Model& model, bsdf::Precision precision) {
  return precision == bsdf::Precision::f64 ? model.evaluate_f64 : model.evaluate_f32;
}

/// Of one run over the points on one thread.
double seconds_of(Evaluate evaluate, const registry::ParameterValues& values, std::span<const bsdf::Point> points,
                  Values& out) {
  const auto start = std::chrono::steady_clock::now();
  evaluate(values, {bsdf::Quantity::S, -1, points}, std::span(out).first(points.size()));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr std::size_t fewest_points = 16;

/// The first of the points, as many as one thread takes `seconds` for.
std::span<const bsdf::Point> points_within(double seconds, Evaluate evaluate, const registry::ParameterValues& values,
                                           std::span<const bsdf::Point> points) {
  if (points.size() <= fewest_points) return points;
  Values out(fewest_points);
  const double each = seconds_of(evaluate, values, points.first(fewest_points), out) / double(fewest_points);
  return points.first(std::size_t(std::clamp(seconds / each, double(fewest_points), double(points.size()))));
}

constexpr double one_run = 1e-3;  // s: short ones find quiet moments on a busy machine

/// The best of several runs on one thread, in ns a point; where points are slow, over fewer of them.
double best_ns(Evaluate evaluate, const registry::ParameterValues& values, std::span<const bsdf::Point> points,
               double seconds) {
  const std::span<const bsdf::Point> timed = points_within(one_run, evaluate, values, points);
  Values out(timed.size());
  double best = 1e300;
  for (double spent = 0; spent < seconds;) {
    const double time = seconds_of(evaluate, values, timed, out);
    best = std::min(best, time);
    spent += time;
  }
  return 1e9 * best / double(timed.size());
}

void set_errors(TierRow& row, const Values& values, const Values& reference) {
  double largest = 0;
  for (const glm::dvec3& value : reference) largest = std::max(largest, value.y);
  std::vector<double> errors;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (reference[i].y > 1e-6 * largest) errors.push_back(std::abs(values[i].y / reference[i].y - 1));
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  row.median_error = errors[errors.size() / 2];
  row.p99_error = errors[std::size_t(0.99 * double(errors.size()))];
  row.max_error = errors.back();
}

bool is_near(const bsdf::Model& model, const registry::ParameterValues& values) {
  return model.near_field && model.near_field(values);
}

/// The values that a field's tiers are compared with; as many points as they were worth.
struct Reference {
  std::span<const bsdf::Point> points;
  Values values;
};

/// Evaluates on all threads at the reference's points, sets the row's errors, and times it.
Result<void> measure(TierRow& row, const bsdf::Model& model, const registry::ParameterValues& values,
                     bsdf::Precision precision, const LobesRequest& request, Reference& reference) {
  Values out(reference.points.size());
  CUTICLE_TRY(bsdf::evaluate(model, values, precision, {bsdf::Quantity::S, -1, reference.points}, out));
  if (row.reference) reference.values = out;
  set_errors(row, out, reference.values);
  row.points = out.size();
  row.ns = best_ns(evaluate_of(model, precision), values, reference.points, request.seconds);
  return {};
}

}  // namespace

std::string finest_settings(const bsdf::Model& model, const std::string& settings) {
  return tiers_of(model, settings).back().settings;
}

Result<std::vector<TierRow>> compare_tiers(const bsdf::Model& model, const std::string& settings,
                                           const LobesRequest& request) {
  const std::vector<bsdf::Point> points = random_points(request.points);
  const std::vector<Tier> tiers = tiers_of(model, settings);
  // The near field is another function than the far field, so each has its own reference.
  std::array<std::optional<Reference>, 2> references;
  std::vector<TierRow> rows;
  for (auto tier = tiers.rbegin(); tier != tiers.rend(); ++tier) {
    CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", tier->settings));
    std::optional<Reference>& reference = references[is_near(model, values)];
    for (const bsdf::Precision precision : {bsdf::Precision::f64, bsdf::Precision::f32}) {
      TierRow row{std::string(model.entry.name), tier->name, precision == bsdf::Precision::f64 ? "f64" : "f32",
                  tier->settings};
      row.reference = !reference;
      if (row.reference) reference = {points_within(request.reference_seconds, model.evaluate_f64, values, points), {}};
      CUTICLE_TRY(measure(row, model, values, precision, request, *reference));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace cuticle::study
