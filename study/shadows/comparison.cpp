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
  comparison.to_light = request.to_light / std::max(1e-300, glm::length(request.to_light));
  comparison.spacing = strands::statistics(*request.groom).spacing;
  comparison.footprint_radius =
      request.footprint_radius > 0 ? request.footprint_radius : shadows::default_footprint_radius(*request.groom);
  comparison.rays = request.rays;
  comparison.receivers = receivers;
  return comparison;
}

void add_baselines(Comparison& comparison) {
  const std::vector<float>& truth = comparison.truth;
  std::vector<double> choosing;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!counts(truth[i])) continue;
    ++comparison.counted;
    comparison.truth_standard_error += double(comparison.truth_errors[i]);
    if (is_in(Half::choosing, i)) choosing.push_back(double(truth[i]));
  }
  comparison.truth_standard_error /= double(comparison.counted);
  comparison.best_constant_value = quantile(choosing, 0.5);
  const std::vector<float> ones(truth.size(), 1.0f), constant(truth.size(), float(comparison.best_constant_value));
  comparison.none = error_statistics(ones, truth, Half::reporting);
  comparison.best_constant = error_statistics(constant, truth, Half::reporting);
}

ComparisonRow row_of(const Candidate& candidate, shadows::Transmittance result, const Comparison& comparison) {
  ComparisonRow row;
  row.method = candidate.method->entry.name;
  row.settings = settings_text(candidate);
  row.values = candidate.values;
  row.choosing = error_statistics(result.values, comparison.truth, Half::choosing);
  row.error = error_statistics(result.values, comparison.truth, Half::reporting);
  row.cost = std::move(result.cost);
  row.total_ms = row.cost.build_ms + row.cost.lookup_ms * double(comparison.vertices) /
                                         double(std::max<std::size_t>(1, comparison.receivers));
  row.transmittance = std::move(result.values);
  return row;
}

/// Points at both ends of the segment at each probe, the one that begins there unless its strand ends there.
std::vector<glm::vec3> segment_ends(const strands::Groom& groom, const Probes& probes) {
  std::vector<glm::vec3> ends;
  for (std::size_t i = 0; i < probes.vertices.size(); ++i) {
    const std::uint32_t v = probes.vertices[i], first = groom.offsets[probes.strands[i]];
    const bool is_last = v + 1 == groom.offsets[probes.strands[i] + 1];
    ends.push_back(groom.positions[is_last ? std::max(first + 1, v) - 1 : v]);
    ends.push_back(groom.positions[is_last ? v : v + 1]);
  }
  return ends;
}
Probes middles(const strands::Groom& groom, Probes probes) {
  const std::vector<glm::vec3> ends = segment_ends(groom, probes);
  for (std::size_t i = 0; i < probes.points.size(); ++i) probes.points[i] = 0.5f * (ends[2 * i] + ends[2 * i + 1]);
  return probes;
}

/// A method at the probes, or its mean over the ends of their segments.
Result<shadows::Transmittance> evaluate_at(const Candidate& candidate, const shadows::Casters& casters,
                                           const Probes& probes, Weights weights) {
  if (weights != Weights::per_vertex)
    return candidate.method->evaluate(casters, {probes.points, probes.strands}, candidate.values);
  const std::vector<glm::vec3> ends = segment_ends(*casters.groom, probes);
  std::vector<std::uint32_t> strands;
  for (const std::uint32_t strand : probes.strands) strands.insert(strands.end(), 2, strand);
  CUTICLE_ASSIGN(auto result, candidate.method->evaluate(casters, {ends, strands}, candidate.values));
  for (std::size_t i = 0; i < probes.points.size(); ++i)
    result.values[i] = 0.5f * (result.values[2 * i] + result.values[2 * i + 1]);
  result.values.resize(probes.points.size());
  return result;
}

Result<void> add_rows(const ComparisonRequest& request, const shadows::Casters& casters, const Probes& probes,
                      Progress& progress, Comparison& comparison) {
  std::size_t done = 0;
  for (const Candidate& candidate : request.candidates) {
    progress.update("methods", done++, request.candidates.size());
    auto result = evaluate_at(candidate, casters, probes, request.weights);
    if (result)
      comparison.rows.push_back(row_of(candidate, std::move(*result), comparison));
    else if (comparison.rows.empty() && done == request.candidates.size())
      return result.error();
    else
      comparison.refused.push_back(
          {std::string(candidate.method->entry.name), settings_text(candidate), result.error().message});
  }
  progress.update("methods", done, request.candidates.size());
  return {};
}

bool has_counted(std::span<const float> truth, Half half) {
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (is_in(half, i) && counts(truth[i])) return true;
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

Probes spread_probes(const strands::Groom& groom, std::size_t count) {
  const std::size_t vertices = groom.vertex_count(), wanted = std::min(count, vertices);
  Probes probes;
  std::vector<std::size_t> chosen;
  // Multiples of the golden ratio, so that no period of the strands' vertex counts is met.
  for (std::size_t i = 0; i < wanted; ++i)
    chosen.push_back(
        wanted == vertices ? i : std::size_t(std::fmod(double(i) * 0.6180339887498949, 1.0) * double(vertices)));
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  for (const std::size_t v : chosen) {
    probes.points.push_back(groom.positions[v]);
    probes.vertices.push_back(std::uint32_t(v));
    const auto after = std::upper_bound(groom.offsets.begin(), groom.offsets.end(), std::uint32_t(v));
    probes.strands.push_back(std::uint32_t(after - groom.offsets.begin()) - 1);
  }
  return probes;
}

ErrorStatistics error_statistics(std::span<const float> values, std::span<const float> truth, Half half) {
  CUTICLE_EXPECT(values.size() == truth.size(), "one value per truth");
  std::vector<double> errors;
  ErrorStatistics statistics;
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!counts(truth[i]) || !is_in(half, i)) continue;
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

Result<Comparison> compare_with_truth(const ComparisonRequest& request, Progress& progress) {
  CUTICLE_EXPECT(request.groom != nullptr, "a request names its groom");
  const shadows::Casters casters{request.groom, request.alpha, request.to_light};
  CUTICLE_TRY(shadows::check(casters, {}));
  Probes probes = spread_probes(*request.groom, request.receivers);
  if (request.weights != Weights::at_vertices) probes = middles(*request.groom, std::move(probes));
  const shadows::Receivers receivers{probes.points, probes.strands};
  Comparison comparison = describe(request, probes.points.size());
  progress.message(fmt::format("truth: {} rays for each of {} receivers", request.rays, probes.points.size()));
  CUTICLE_ASSIGN(auto truth, evaluate_truth(request, casters, receivers, comparison.footprint_radius));
  if (!has_counted(truth.values, Half::choosing) || !has_counted(truth.values, Half::reporting))
    return bad_input("no receiver has a transmittance between 0.05 and 0.95: nothing to compare",
                     "another radius, alpha or light, more receivers, or check metres per unit");
  comparison.truth_cost = truth.cost;
  comparison.points = probes.points;
  comparison.truth = std::move(truth.values);
  comparison.truth_errors = std::move(truth.standard_error);
  add_baselines(comparison);
  CUTICLE_TRY(add_rows(request, casters, probes, progress, comparison));
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
