// What study/README.md describes: study.json, study.csv and receivers.csv.
#include <algorithm>

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/json.h"
#include "study/shadows/comparison.h"

namespace cuticle::study {
namespace {

Json error_json(std::string_view method, const ErrorStatistics& error) {
  return {{"method", method},
          {"mean_error", error.mean},
          {"p95_error", error.percentile_95},
          {"max_error", error.maximum},
          {"bias", error.bias},
          {"mean_interval", error.mean_interval},
          {"bias_interval", error.bias_interval}};
}

Json device_json(const DeviceCost& cost) {
  Json json{{"device", cost.device},
            {"wall_ms", cost.wall_ms},
            {"build_timestamp_ms", cost.build_ms},
            {"lookup_timestamp_ms", cost.lookup_ms}};
  json["passes"] = Json::list();
  for (const auto& [name, milliseconds] : cost.passes)
    json["passes"].push_back({{"name", name}, {"timestamp_ms", milliseconds}});
  return json;
}

Json row_json(const ComparisonRow& row) {
  Json json = error_json(row.method, row.error);
  json["settings"] = row.settings;
  json["choosing_error"] = row.choosing.mean;
  json.update(Json::parse(registry::to_json(row.values)).value());
  json["bias"] = row.error.bias;  // not the parameter of that name
  if (json.contains("slices")) json["layers"] = json["slices"];
  json["build_ms"] = row.cost.build_ms;
  json["lookup_ms"] = row.cost.lookup_ms;
  json["total_ms"] = row.total_ms;
  json["bytes"] = row.cost.bytes;
  json["light_left"] = row.light_left;
  json["light_left_interval"] = row.light_left_interval;
  json["device"] = row.cost.device;
  if (row.on_device) json["on_device"] = device_json(*row.on_device);
  if (row.flicker) json["light_flicker"] = row.flicker->light;
  if (row.flicker && row.flicker->motion) json["motion_flicker"] = *row.flicker->motion;
  return json;
}

Json baselines_json(const Comparison& comparison) {
  Json constant = error_json("best constant", comparison.best_constant);
  constant["value"] = comparison.best_constant_value;
  return Json::list({error_json("none", comparison.none), constant});
}

Json truth_json(const Comparison& comparison) {
  return {{"rays", comparison.rays},
          {"receivers", comparison.receivers},
          {"counted", comparison.counted},
          {"mean_standard_error", comparison.truth_standard_error},
          {"light_left", comparison.light_left},
          {"ms", comparison.truth_cost.build_ms + comparison.truth_cost.lookup_ms},
          {"device", comparison.truth_cost.device}};
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

std::string csv_line(const ComparisonRow& row) {
  const std::string light = row.flicker ? fmt::format("{:.6g}", row.flicker->light) : "";
  const std::string motion = row.flicker && row.flicker->motion ? fmt::format("{:.6g}", *row.flicker->motion) : "";
  const std::string device = row.on_device
                                 ? fmt::format("{:.4g},{:.4g},{:.4g},\"{}\"", row.on_device->wall_ms,
                                               row.on_device->build_ms, row.on_device->lookup_ms, row.on_device->device)
                                 : ",,,";
  return fmt::format(
      "{},\"{}\",{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g},{:.4g},{:.4g},{},\"{}\",{},{},{},{:.6g},{:.3g}"
      "\n",
      row.method, row.settings, layers_of(row.values), cell(row.values, "resolution"), row.error.mean,
      row.error.mean_interval, row.error.percentile_95, row.error.maximum, row.error.bias, row.choosing.mean,
      row.cost.build_ms, row.cost.lookup_ms, row.total_ms, row.cost.bytes, row.cost.device, light, motion, device,
      row.light_left, row.light_left_interval);
}
ComparisonRow baseline_row(std::string_view method, const ErrorStatistics& error, double light_left) {
  ComparisonRow row;
  row.light_left = light_left;
  row.method = method;
  row.choosing = row.error = error;
  return row;
}

Json refused_json(const Comparison& comparison) {
  Json list = Json::list();
  for (const Refusal& refusal : comparison.refused)
    list.push_back({{"method", refusal.method}, {"settings", refusal.settings}, {"why", refusal.why}});
  return list;
}

/// The best row of each method on the choosing half, in the order of the rows.
std::vector<const ComparisonRow*> best_of_each(const Comparison& comparison) {
  std::vector<const ComparisonRow*> best;
  for (const ComparisonRow& row : comparison.rows) {
    const auto same =
        std::find_if(best.begin(), best.end(), [&](const auto* other) { return other->method == row.method; });
    if (same == best.end())
      best.push_back(&row);
    else if (row.choosing.mean < (*same)->choosing.mean)
      *same = &row;
  }
  return best;
}

}  // namespace

std::string to_json(const Comparison& comparison) {
  Json json{{"name", comparison.name}, {"title", comparison.title}};
  if (comparison.at_pixels)
    json["x"] = {{"key", "resolution"}, {"label", "resolution: at most its square of texels"}, {"scale", "log"}};
  else
    json["x"] = {{"key", "total_ms"}, {"label", "build + lookup at every vertex, ms"}, {"scale", "log"}};
  json["y"] = {{"key", "mean_error"}, {"label", "mean |error| of transmittance"}, {"scale", "log"}};
  json["series"] = comparison.at_pixels ? "layers" : "resolution";
  json["label"] = "layers";
  json["pareto"] = !comparison.at_pixels;
  json["groom"] = {{"name", comparison.groom_name},
                   {"strands", comparison.strands},
                   {"vertices", comparison.vertices},
                   {"spacing_m", comparison.spacing}};
  json["alpha"] = comparison.alpha;
  json["to_light"] = {comparison.to_light.x, comparison.to_light.y, comparison.to_light.z};
  json["footprint_m"] = comparison.footprint_radius;
  json["truth"] = truth_json(comparison);
  json["device"] = comparison.rows.empty() ? "" : comparison.rows.front().cost.device;
  json["baselines"] = baselines_json(comparison);
  json["rows"] = Json::list();
  for (const ComparisonRow& row : comparison.rows) json["rows"].push_back(row_json(row));
  if (!comparison.refused.empty()) json["refused"] = refused_json(comparison);
  return json.dump(2) + "\n";
}

std::string to_csv(const Comparison& comparison) {
  std::string text =
      "method,settings,layers,resolution,mean_error,mean_interval,p95_error,max_error,bias,choosing_error,build_ms,"
      "lookup_ms,total_ms,bytes,device,light_flicker,motion_flicker,device_wall_ms,"
      "device_build_ms,device_lookup_ms,on_device,light_left,light_left_interval\n";
  text += csv_line(baseline_row("none", comparison.none, 1));
  text += csv_line(baseline_row("best constant", comparison.best_constant, comparison.best_constant_value));
  for (const ComparisonRow& row : comparison.rows) text += csv_line(row);
  return text;
}

std::string contact_csv(const Comparison& comparison) {
  std::string text = "method,settings,from_mm,to_mm,receivers,mean_error,mean_interval,bias\n";
  for (const ComparisonRow& row : comparison.rows)
    for (const ContactError& band : row.contact)
      text += fmt::format("{},\"{}\",{:g},{:g},{},{:.6g},{:.3g},{:.6g}\n", row.method, row.settings, 1e3 * band.from,
                          1e3 * band.to, band.receivers, band.error.mean, band.error.mean_interval, band.error.bias);
  return text;
}

std::string receivers_csv(const Comparison& comparison) {
  const auto columns = best_of_each(comparison);
  std::string text = "x,y,z,truth,standard_error";
  for (const ComparisonRow* row : columns) {
    std::string settings = row->settings;
    std::replace(settings.begin(), settings.end(), ',', ';');
    text += fmt::format(",{} {}", row->method, settings);
  }
  for (std::size_t i = 0; i < comparison.points.size(); ++i) {
    const glm::vec3& p = comparison.points[i];
    text += fmt::format("\n{},{},{},{:.6g},{:.3g}", p.x, p.y, p.z, comparison.truth[i], comparison.truth_errors[i]);
    for (const ComparisonRow* row : columns) text += fmt::format(",{:.6g}", row->transmittance[i]);
  }
  return text + "\n";
}

Result<void> write_comparison(const Comparison& comparison, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_text_file(folder + "/study.csv", to_csv(comparison)));
  CUTICLE_TRY(write_text_file(folder + "/contact.csv", contact_csv(comparison)));
  CUTICLE_TRY(write_text_file(folder + "/receivers.csv", receivers_csv(comparison)));
  return write_text_file(folder + "/study.json", to_json(comparison));
}

}  // namespace cuticle::study
