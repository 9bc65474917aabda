// Error and time of a model's tiers.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>

#include <fmt/core.h>

#include <cuticle/study/lobes/lobes_study.h>

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

/// The best of several runs over all points on one thread, in ns a point.
double best_ns(Evaluate evaluate, const registry::ParameterValues& values, const std::vector<bsdf::Point>& points,
               int repeats, Values& out) {
  double best = 1e300;
  for (int run = 0; run < repeats; ++run) {
    const auto start = std::chrono::steady_clock::now();
    evaluate(values, {bsdf::Quantity::S, -1, points}, out);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count());
    if (time.count() > 1e9) break;
  }
  return best / double(points.size());
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

}  // namespace

Result<std::vector<TierRow>> compare_tiers(const bsdf::Model& model, const std::string& settings,
                                           const LobesRequest& request) {
  const std::vector<bsdf::Point> points = random_points(request.points);
  const std::vector<Tier> tiers = tiers_of(model, settings);
  // The near field is another function than the far field, so each has its own reference.
  std::array<std::optional<Values>, 2> references;
  Values out(points.size());
  std::vector<TierRow> rows;
  for (auto tier = tiers.rbegin(); tier != tiers.rend(); ++tier) {
    CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(model, "", tier->settings));
    std::optional<Values>& reference = references[is_near(model, values)];
    for (const bool in_double : {true, false}) {
      TierRow row{std::string(model.entry.name), tier->name, in_double ? "f64" : "f32", tier->settings};
      row.ns = best_ns(in_double ? model.evaluate_f64 : model.evaluate_f32, values, points, request.repeats, out);
      row.reference = !reference;
      if (row.reference) reference = out;
      set_errors(row, out, *reference);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace cuticle::study
