#include <cuticle/study/shadows/comparison.h>

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <cuticle/shadows/footprint.h>
#include <cuticle/strands/statistics.h>

namespace cuticle::study {
namespace {

bool counts(float truth) { return truth > 0.05f && truth < 0.95f; }

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
  comparison.to_light = request.to_light / std::max(1e-300, glm::length(request.to_light));
  comparison.spacing = strands::statistics(*request.groom).spacing;
  comparison.footprint_radius = request.footprint_radius > 0 ? request.footprint_radius : shadows::default_footprint_radius(*request.groom);
  comparison.rays = request.rays;
  comparison.receivers = receivers;
  return comparison;
}

void add_baselines(const shadows::Transmittance& truth, Comparison& comparison) {
  std::vector<double> counted;
  double noise = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    if (!counts(truth.values[i])) continue;
    counted.push_back(double(truth.values[i]));
    noise += double(truth.standard_error[i]);
  }
  comparison.counted = counted.size();
  comparison.truth_standard_error = noise / double(counted.size());
  comparison.best_constant_value = quantile(counted, 0.5);
  const std::vector<float> ones(truth.values.size(), 1.0f), constant(truth.values.size(), float(comparison.best_constant_value));
  comparison.none = error_statistics(ones, truth.values);
  comparison.best_constant = error_statistics(constant, truth.values);
}

Result<void> add_rows(const ComparisonRequest& request, const shadows::Casters& casters, const shadows::Receivers& receivers,
                      std::span<const float> truth, Progress& progress, Comparison& comparison) {
  for (const Candidate& candidate : request.candidates) {
    progress.update("methods", comparison.rows.size(), request.candidates.size());
    CUTICLE_ASSIGN(const auto result, candidate.method->evaluate(casters, receivers, candidate.values));
    comparison.rows.push_back({std::string(candidate.method->entry.name), settings_text(candidate), candidate.values,
                               error_statistics(result.values, truth), result.cost});
  }
  progress.update("methods", request.candidates.size(), request.candidates.size());
  return {};
}

}  // namespace

Probes spread_probes(const strands::Groom& groom, std::size_t count) {
  const std::size_t vertices = groom.vertex_count(), wanted = std::min(count, vertices);
  Probes probes;
  std::vector<std::size_t> chosen;
  // Multiples of the golden ratio, so that no period of the strands' vertex counts is met.
  for (std::size_t i = 0; i < wanted; ++i)
    chosen.push_back(wanted == vertices ? i : std::size_t(std::fmod(double(i) * 0.6180339887498949, 1.0) * double(vertices)));
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  for (const std::size_t v : chosen) {
    probes.points.push_back(groom.positions[v]);
    const auto after = std::upper_bound(groom.offsets.begin(), groom.offsets.end(), std::uint32_t(v));
    probes.strands.push_back(std::uint32_t(after - groom.offsets.begin()) - 1);
  }
  return probes;
}

ErrorStatistics error_statistics(std::span<const float> values, std::span<const float> truth) {
  CUTICLE_EXPECT(values.size() == truth.size(), "one value per truth");
  std::vector<double> errors;
  ErrorStatistics statistics;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!counts(truth[i])) continue;
    const double error = double(values[i]) - double(truth[i]);
    errors.push_back(std::abs(error));
    statistics.mean += std::abs(error);
    statistics.bias += error;
  }
  if (errors.empty()) return {};
  statistics.mean /= double(errors.size());
  statistics.bias /= double(errors.size());
  statistics.percentile_95 = quantile(errors, 0.95);
  statistics.maximum = *std::max_element(errors.begin(), errors.end());
  return statistics;
}

Result<Comparison> compare_with_truth(const ComparisonRequest& request, Progress& progress) {
  CUTICLE_EXPECT(request.groom != nullptr, "a request names its groom");
  const Probes probes = spread_probes(*request.groom, request.receivers);
  const shadows::Casters casters{request.groom, request.alpha, request.to_light};
  const shadows::Receivers receivers{probes.points, probes.strands};
  CUTICLE_TRY(shadows::check(casters, receivers));
  Comparison comparison = describe(request, probes.points.size());
  progress.message(fmt::format("truth: {} rays for each of {} receivers", request.rays, probes.points.size()));
  CUTICLE_ASSIGN(const auto truth, evaluate_truth(request, casters, receivers, comparison.footprint_radius));
  if (std::none_of(truth.values.begin(), truth.values.end(), counts))
    return bad_input("no receiver has a transmittance between 0.05 and 0.95: nothing to compare",
                     "another radius, alpha or light, or check metres per unit");
  comparison.truth_cost = truth.cost;
  add_baselines(truth, comparison);
  CUTICLE_TRY(add_rows(request, casters, receivers, truth.values, progress, comparison));
  return comparison;
}

const ComparisonRow* best_choice(const Comparison& comparison, double max_error, double budget_ms) {
  const auto time = [](const ComparisonRow& row) { return row.cost.build_ms + row.cost.lookup_ms; };
  const auto rank = [&](const ComparisonRow& row) { return max_error > 0 ? time(row) : row.error.mean; };
  const ComparisonRow* best = nullptr;
  for (const ComparisonRow& row : comparison.rows) {
    const bool meets = (max_error <= 0 || row.error.mean <= max_error) && (budget_ms <= 0 || time(row) <= budget_ms);
    if (meets && (best == nullptr || rank(row) < rank(*best))) best = &row;
  }
  return best;
}

}  // namespace cuticle::study
