#include "study/shadows/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "shadows/footprint.h"
#include "shadows/light_frame.h"
#include "strands/statistics.h"

namespace cuticle::study {
namespace {

bool is_in(Half half, std::size_t receiver) {
  return half == Half::both || (half == Half::choosing) == (receiver % 2 == 0);
}

double quantile(std::vector<double> values, double fraction) {
  const auto middle = values.begin() + std::ptrdiff_t(fraction * double(values.size() - 1));
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Result<shadows::Transmittance> evaluate_truth(const ComparisonRequest& request, const shadows::Casters& casters,
                                              const shadows::Receivers& receivers, double footprint) {
  auto method = shadows::find_method("truth");
  if (!method) return usage_error("this build has no ray-traced truth", "configure with Embree 3 (CUTICLE_EMBREE=ON)");
  const std::string set = fmt::format("rays={},footprint_radius_mm={:.17g}", request.rays, 1e3 * footprint);
  CUTICLE_ASSIGN(const auto values, registry::parse_assignments((*method)->entry.parameters, set));
  return (*method)->evaluate(casters, receivers, values);
}

Comparison describe(const ComparisonRequest& request, std::size_t receivers) {
  Comparison comparison;
  comparison.name = request.name;
  comparison.title = request.title;
  comparison.groom_name = request.groom_name;
  comparison.strands = request.groom->strand_count();
  comparison.vertices = request.groom->vertex_count();
  comparison.alpha = request.alpha;
  comparison.to_light = shadows::unit_to_light(request.to_light).value();
  comparison.spacing = strands::statistics(*request.groom).spacing;
  comparison.footprint_radius = request.footprint_radius > 0 ? request.footprint_radius
                                : request.to_camera          ? 0
                                                             : shadows::default_footprint_radius(*request.groom);
  comparison.rays = comparison.footprint_radius > 0 ? request.rays : 1;
  comparison.at_pixels = request.to_camera.has_value();
  comparison.receivers = receivers;
  return comparison;
}

void add_baselines(Comparison& comparison) {
  const std::vector<float>& truth = comparison.truth;
  std::vector<double> choosing;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!is_counted(truth[i], comparison.errors_of())) continue;
    ++comparison.counted;
    comparison.truth_standard_error += double(comparison.truth_errors[i]);
    if (is_in(Half::choosing, i)) choosing.push_back(double(truth[i]));
  }
  comparison.truth_standard_error /= double(comparison.counted);
  comparison.best_constant_value = quantile(choosing, 0.5);
  const std::vector<float> ones(truth.size(), 1.0f), constant(truth.size(), float(comparison.best_constant_value));
  comparison.none = error_statistics(ones, truth, Half::reporting, comparison.errors_of());
  comparison.best_constant = error_statistics(constant, truth, Half::reporting, comparison.errors_of());
}

double mean_of(std::span<const float> values) {
  double sum = 0;
  for (const float value : values) sum += double(value);
  return sum / double(std::max<std::size_t>(1, values.size()));
}

/// Half width of 95 % of the mean difference of two lists.
double difference_interval(std::span<const float> a, std::span<const float> b) {
  const double count = double(a.size()), mean = mean_of(a) - mean_of(b);
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += std::pow(double(a[i]) - double(b[i]) - mean, 2);
  return count > 1 ? 1.96 * std::sqrt(squares / count / (count - 1)) : 0;
}

ComparisonRow row_of(const Candidate& candidate, shadows::Transmittance result, const Comparison& comparison) {
  ComparisonRow row;
  row.method = candidate.method->entry.name;
  row.settings = settings_text(candidate);
  row.values = candidate.values;
  row.choosing = error_statistics(result.values, comparison.truth, Half::choosing, comparison.errors_of());
  row.error = error_statistics(result.values, comparison.truth, Half::reporting, comparison.errors_of());
  row.cost = std::move(result.cost);
  row.total_ms = row.cost.build_ms + row.cost.lookup_ms * double(comparison.vertices) /
                                         double(std::max<std::size_t>(1, comparison.receivers));
  row.light_left = mean_of(result.values);
  row.light_left_interval = difference_interval(result.values, comparison.truth);
  row.contact = contact_errors(result.values, comparison);
  row.transmittance = std::move(result.values);
  return row;
}

Probes probes_of(const ComparisonRequest& request) {
  if (request.to_camera) return visible_probes(*request.groom, *request.to_camera, request.receivers);
  return request.weights == Weights::at_vertices ? spread_probes(*request.groom, request.receivers)
                                                 : middle_probes(*request.groom, request.receivers);
}

/// A candidate's row, with its flicker where the truth under a turned light is known.
Result<ComparisonRow> measure_row(const Candidate& candidate, const FlickerScene& scene, const Comparison& comparison) {
  CUTICLE_ASSIGN(auto result, evaluate_at(candidate, scene.casters, *scene.probes, scene.weights));
  ComparisonRow row = row_of(candidate, std::move(result), comparison);
  if (scene.turned_truth.empty()) return row;
  CUTICLE_ASSIGN(row.flicker, measure_flicker(candidate, scene, row.transmittance));
  return row;
}

Result<void> add_rows(const ComparisonRequest& request, const FlickerScene& scene, Progress& progress,
                      Comparison& comparison) {
  std::size_t done = 0;
  for (const Candidate& candidate : request.candidates) {
    progress.update("methods", done++, request.candidates.size());
    auto row = measure_row(candidate, scene, comparison);
    if (row)
      comparison.rows.push_back(std::move(*row));
    else if (comparison.rows.empty() && done == request.candidates.size())
      return row.error();
    else
      comparison.refused.push_back(
          {std::string(candidate.method->entry.name), settings_text(candidate), row.error().message});
  }
  progress.update("methods", done, request.candidates.size());
  return {};
}

bool has_counted(std::span<const float> truth, Half half) {
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (is_in(half, i) && is_counted(truth[i], Counted::partly_lit)) return true;
  return false;
}

/// By how much a row passes what is asked for: at most 1 where it meets it.
double excess(const ComparisonRow& row, const Request& request) {
  double factor = 0;
  if (request.max_error > 0) factor = std::max(row.error.mean, row.choosing.mean) / request.max_error;
  if (request.budget_ms > 0) factor = std::max(factor, row.total_ms / request.budget_ms);
  return factor;
}

}  // namespace

ErrorStatistics error_statistics(std::span<const float> values, std::span<const float> truth, Half half,
                                 Counted counted) {
  CUTICLE_EXPECT(values.size() == truth.size(), "one value per truth");
  std::vector<double> errors;
  ErrorStatistics statistics;
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_counted(truth[i], counted) || !is_in(half, i)) continue;
    const double error = double(values[i]) - double(truth[i]);
    errors.push_back(std::abs(error));
    statistics.mean += std::abs(error);
    statistics.bias += error;
    squares += error * error;
  }
  if (errors.empty()) return {};
  const double count = double(errors.size());
  statistics.mean /= count;
  statistics.bias /= count;
  const auto interval = [&](double mean) {
    return 1.96 * std::sqrt(std::max(0.0, squares / count - mean * mean) / std::max(1.0, count - 1));
  };
  statistics.mean_interval = interval(statistics.mean);
  statistics.bias_interval = interval(statistics.bias);
  statistics.percentile_95 = quantile(errors, 0.95);
  statistics.maximum = *std::max_element(errors.begin(), errors.end());
  return statistics;
}

std::vector<ContactError> contact_errors(std::span<const float> values, const Comparison& comparison) {
  constexpr double k_endless = std::numeric_limits<double>::infinity();
  std::vector<ContactError> bands;
  for (double from = 0, to = 5e-4; from < 0.1; from = to, to = 2 * to < 0.1 ? 2 * to : k_endless) {
    std::vector<float> there, truth;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double away = double(comparison.occluders[i]);
      if (!(away >= from && away < to) || !is_counted(comparison.truth[i], comparison.errors_of())) continue;
      there.push_back(values[i]);
      truth.push_back(comparison.truth[i]);
    }
    if (!there.empty())
      bands.push_back({from, to, there.size(), error_statistics(there, truth, Half::both, comparison.errors_of())});
  }
  return bands;
}

Result<Comparison> compare_with_truth(const ComparisonRequest& request, Progress& progress) {
  CUTICLE_EXPECT(request.groom != nullptr, "a request names its groom");
  CUTICLE_ASSIGN(const glm::dvec3 to_light, shadows::unit_to_light(request.to_light));
  const shadows::Casters casters{request.groom, request.alpha, to_light};
  CUTICLE_TRY(shadows::check(casters, {}));
  const Probes probes = probes_of(request);
  const shadows::Receivers receivers = probes.receivers();
  Comparison comparison = describe(request, probes.points.size());
  progress.message(fmt::format("truth: {} {} for each of {} receivers", comparison.rays,
                               comparison.rays == 1 ? "ray" : "rays", probes.points.size()));
  CUTICLE_ASSIGN(auto truth, evaluate_truth(request, casters, receivers, comparison.footprint_radius));
  if (!request.to_camera && !(has_counted(truth.values, Half::choosing) && has_counted(truth.values, Half::reporting)))
    return bad_input("no receiver has a transmittance between 0.05 and 0.95: nothing to compare",
                     "another radius, alpha or light, more receivers, or check metres per unit");
  comparison.truth_cost = truth.cost;
  comparison.points = probes.points;
  comparison.truth = std::move(truth.values);
  comparison.truth_errors = std::move(truth.standard_error);
  comparison.occluders = std::move(truth.occluders);
  comparison.light_left = mean_of(comparison.truth);
  add_baselines(comparison);
  shadows::Transmittance turned;
  if (request.flicker) {
    progress.message("truth under a light turned by 0.1 degree");
    const shadows::Casters under_turned{request.groom, request.alpha, turned_light(to_light)};
    CUTICLE_ASSIGN(turned, evaluate_truth(request, under_turned, receivers, comparison.footprint_radius));
  }
  const FlickerScene scene{casters, &probes, request.weights, comparison.truth, turned.values};
  CUTICLE_TRY(add_rows(request, scene, progress, comparison));
  return comparison;
}

const ComparisonRow* best_choice(const Comparison& comparison, const Request& request) {
  const auto rank = [&](const ComparisonRow& row) { return request.max_error > 0 ? row.total_ms : row.choosing.mean; };
  const ComparisonRow* best = nullptr;
  for (const ComparisonRow& row : comparison.rows)
    if (excess(row, request) <= 1 && (best == nullptr || rank(row) < rank(*best))) best = &row;
  return best;
}

Nearest nearest_to(const Comparison& comparison, const Request& request) {
  CUTICLE_EXPECT(!comparison.rows.empty(), "something was compared");
  const ComparisonRow& row =
      *std::min_element(comparison.rows.begin(), comparison.rows.end(),
                        [&](const auto& a, const auto& b) { return excess(a, request) < excess(b, request); });
  Nearest nearest{&row, ""};
  const double error = std::max(row.error.mean, row.choosing.mean);
  if (request.max_error > 0 && error > request.max_error)
    nearest.because = fmt::format("its mean error is {:.4f}, more than {:g}", error, request.max_error);
  if (request.budget_ms > 0 && row.total_ms > request.budget_ms)
    nearest.because += fmt::format("{}it takes {:.3g} ms, more than {:g}", nearest.because.empty() ? "" : " and ",
                                   row.total_ms, request.budget_ms);
  return nearest;
}

}  // namespace cuticle::study
