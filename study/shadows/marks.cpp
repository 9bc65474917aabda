#include "study/shadows/marks.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/json/json.h"

namespace cuticle::study {
namespace {

/// Means over the lights of one setting.
struct MeanRow {
  double choosing = 0, error = 0, interval = 0, bias = 0;
  std::size_t bytes = 0;
};
MeanRow mean_row(std::span<const Comparison> lights, std::size_t row) {
  MeanRow mean;
  double squares = 0;
  for (const Comparison& light : lights) {
    const ComparisonRow& of_light = light.rows[row];
    mean.choosing += of_light.choosing.mean / double(lights.size());
    mean.error += of_light.error.mean / double(lights.size());
    mean.bias += of_light.error.bias / double(lights.size());
    squares += of_light.error.mean_interval * of_light.error.mean_interval;
    mean.bytes = std::max(mean.bytes, of_light.cost.bytes);
  }
  mean.interval = std::sqrt(squares) / double(lights.size());
  return mean;
}

/// The mark's candidates are the `count` rows from `first`.
MarkResult result_of(const Mark& mark, std::span<const Comparison> lights, std::size_t first) {
  MarkResult result;
  result.mark = &mark;
  double best = 1;
  for (std::size_t i = first; i < first + mark.candidates.size(); ++i) {
    const MeanRow row = mean_row(lights, i);
    if ((mark.bytes > 0 && row.bytes > mark.bytes) || row.choosing >= best) continue;
    best = row.choosing;
    result.settings = lights[0].rows[i].settings;
    result.error = row.error;
    result.interval = row.interval;
    result.bias = row.bias;
    result.bytes = row.bytes;
  }
  return result;
}

double mean_over_lights(const MarksReport& report, const auto& value) {
  double sum = 0;
  for (const Comparison& light : report.lights) sum += value(light);
  return sum / double(report.lights.size());
}

Result<Comparison> compare_light(const MarksFile& file, const glm::dvec3& light, Progress& progress) {
  ComparisonRequest request;
  request.groom_name = file.name;
  request.groom = &file.groom;
  request.alpha = file.alpha;
  request.to_light = light;
  request.footprint_radius = file.footprint_radius;
  request.rays = file.rays;
  request.receivers = file.receivers;
  for (const Mark& mark : file.marks)
    request.candidates.insert(request.candidates.end(), mark.candidates.begin(), mark.candidates.end());
  CUTICLE_ASSIGN(Comparison comparison, compare_with_truth(request, progress));
  if (comparison.refused.empty()) return comparison;
  const Refusal& refusal = comparison.refused.front();
  return usage_error(fmt::format("{} {}: {}", refusal.method, refusal.settings, refusal.why));
}

}  // namespace

Result<MarksReport> measure_marks(const MarksFile& file, Progress& progress) {
  MarksReport report;
  for (const glm::dvec3& light : file.lights) {
    CUTICLE_ASSIGN(Comparison comparison, compare_light(file, light, progress));
    report.lights.push_back(std::move(comparison));
  }
  std::size_t first = 0;
  for (const Mark& mark : file.marks) {
    report.results.push_back(result_of(mark, report.lights, first));
    first += mark.candidates.size();
  }
  return report;
}

std::string to_text(const MarksFile& file, const MarksReport& report) {
  const Comparison& any = report.lights.front();
  std::string text = fmt::format(
      "{}: {} strands, spacing {:.4g} mm, footprint radius {:.4g} mm, {} lights, {} receivers, {} rays\n", file.name,
      any.strands, 1e3 * any.spacing, 1e3 * any.footprint_radius, report.lights.size(), any.receivers, any.rays);
  text += fmt::format("noise of the truth {:.4f}; none {:.4f}, best constant {:.4f}\n\n",
                      mean_over_lights(report, [](const Comparison& c) { return c.truth_standard_error; }),
                      mean_over_lights(report, [](const Comparison& c) { return c.none.mean; }),
                      mean_over_lights(report, [](const Comparison& c) { return c.best_constant.mean; }));
  for (const MarkResult& result : report.results)
    text +=
        fmt::format("{:<5}{:<34} {:.4f} +- {:.4f}{}, bias {:+.4f}, {} bytes: {}\n",
                    result.mark->error == 0 ? ""
                    : result.met()          ? "met"
                                            : "NOT",
                    result.mark->name, result.error, result.interval,
                    result.mark->error == 0 ? "" : fmt::format(" (at most {:.4f})", result.mark->error), result.bias,
                    result.bytes, result.settings.empty() ? "no setting keeps the bytes" : result.settings);
  return text;
}

std::string to_json(const MarksFile& file, const MarksReport& report) {
  Json json{{"name", file.name}, {"marks", Json::list()}};
  for (const MarkResult& result : report.results)
    json["marks"].push_back({{"name", result.mark->name},
                             {"method", result.mark->method},
                             {"settings", result.settings},
                             {"mean_error", result.error},
                             {"mean_interval", result.interval},
                             {"bias", result.bias},
                             {"at_most", result.mark->error},
                             {"bytes", result.bytes},
                             {"most_bytes", result.mark->bytes},
                             {"met", result.met()}});
  json["lights"] = Json::list();
  for (const Comparison& light : report.lights) json["lights"].push_back(Json::parse(to_json(light)).value());
  return json.dump(2) + "\n";
}

}  // namespace cuticle::study
