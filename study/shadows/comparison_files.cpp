// What study/README.md describes: study.json and study.csv.
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cuticle/core/file.h>
#include <cuticle/study/shadows/comparison.h>

namespace cuticle::study {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(std::string_view method, const ErrorStatistics& error) {
  return {{"method", method}, {"mean_error", error.mean}, {"p95_error", error.percentile_95}, {"max_error", error.maximum},
          {"bias", error.bias}};
}

Json row_json(const ComparisonRow& row) {
  Json json = error_json(row.method, row.error);
  json["settings"] = row.settings;
  json.update(Json::parse(registry::to_json(row.values)));
  if (json.contains("slices")) json["layers"] = json["slices"];
  json["build_ms"] = row.cost.build_ms;
  json["lookup_ms"] = row.cost.lookup_ms;
  json["total_ms"] = row.cost.build_ms + row.cost.lookup_ms;
  json["bytes"] = row.cost.bytes;
  json["device"] = row.cost.device;
  return json;
}

Json baselines_json(const Comparison& comparison) {
  Json constant = error_json("best constant", comparison.best_constant);
  constant["value"] = comparison.best_constant_value;
  return Json::array({error_json("none", comparison.none), constant});
}

Json truth_json(const Comparison& comparison) {
  return {{"rays", comparison.rays}, {"receivers", comparison.receivers}, {"counted", comparison.counted},
          {"mean_standard_error", comparison.truth_standard_error},
          {"ms", comparison.truth_cost.build_ms + comparison.truth_cost.lookup_ms}, {"device", comparison.truth_cost.device}};
}

std::string cell(const registry::ParameterValues& values, std::string_view name) {
  const auto found = values.all().find(name);
  return found == values.all().end() ? "" : registry::to_text(found->second);
}

/// Slices of an opacity map, layers of a deep one.
std::string layers_of(const registry::ParameterValues& values) {
  const std::string slices = cell(values, "slices");
  return slices.empty() ? cell(values, "layers") : slices;
}

std::string csv_line(std::string_view method, std::string_view settings, const registry::ParameterValues& values,
                     const ErrorStatistics& error, const shadows::Cost& cost) {
  return fmt::format("{},\"{}\",{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g},{:.4g},{:.4g},{},\"{}\"\n", method, settings, layers_of(values),
                     cell(values, "resolution"), error.mean, error.percentile_95, error.maximum, error.bias, cost.build_ms, cost.lookup_ms,
                     cost.build_ms + cost.lookup_ms, cost.bytes, cost.device);
}

}  // namespace

std::string to_json(const Comparison& comparison) {
  Json json{{"name", comparison.name}, {"title", comparison.title}};
  json["x"] = {{"key", "total_ms"}, {"label", "build + lookup, ms"}, {"scale", "log"}};
  json["y"] = {{"key", "mean_error"}, {"label", "mean |error| of transmittance"}, {"scale", "log"}};
  json["series"] = "resolution";
  json["label"] = "layers";
  json["groom"] = {{"name", comparison.groom_name}, {"strands", comparison.strands}, {"vertices", comparison.vertices},
                   {"spacing_m", comparison.spacing}};
  json["alpha"] = comparison.alpha;
  json["to_light"] = {comparison.to_light.x, comparison.to_light.y, comparison.to_light.z};
  json["footprint_m"] = comparison.footprint_radius;
  json["truth"] = truth_json(comparison);
  json["device"] = comparison.rows.empty() ? "" : comparison.rows.front().cost.device;
  json["baselines"] = baselines_json(comparison);
  json["rows"] = Json::array();
  for (const ComparisonRow& row : comparison.rows) json["rows"].push_back(row_json(row));
  return json.dump(2) + "\n";
}

std::string to_csv(const Comparison& comparison) {
  std::string text = "method,settings,layers,resolution,mean_error,p95_error,max_error,bias,build_ms,lookup_ms,total_ms,bytes,device\n";
  text += csv_line("none", "", {}, comparison.none, {});
  text += csv_line("best constant", "", {}, comparison.best_constant, {});
  for (const ComparisonRow& row : comparison.rows) text += csv_line(row.method, row.settings, row.values, row.error, row.cost);
  return text;
}

Result<void> write_comparison(const Comparison& comparison, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_text_file(folder + "/study.csv", to_csv(comparison)));
  return write_text_file(folder + "/study.json", to_json(comparison));
}

}  // namespace cuticle::study
