// The files of a study (study/README.md).
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/core.h>

#include "core/file.h"
#include "study/engine/machine.h"
#include "study/engine/run.h"

namespace cuticle::study {
namespace {

std::string_view name_of(Mean mean) {
  constexpr std::string_view k_names[] = {"arithmetic", "root mean square", "squares", "root of squares"};
  return k_names[std::size_t(mean)];
}

Json interval_json(const Interval& interval) {
  return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};  // infinite: null
}

Json knobs_json(const std::vector<Knob>& knobs) {
  Json json = Json::object();
  for (const Knob& knob : knobs) json[knob.name] = knob.value;
  return json;
}

Json metric_json(const Metric& metric, const MetricResult& result) {
  return {{"metric", metric.name},
          {"mean", interval_json(result.all.mean)},
          {"median", result.all.median},
          {"p95", result.all.percentile_95},
          {"p99", result.all.percentile_99},
          {"max", result.all.maximum},
          {"items", result.all.items},
          {"choosing", result.choosing.mean.value},
          {"judging", result.judging.mean.value}};
}

Json point_json(const Group& group, const PointResult& point) {
  Json metrics = Json::list();
  for (std::size_t m = 0; m < group.metrics.size(); ++m)
    metrics.push_back(metric_json(group.metrics[m], point.metrics[m]));
  return {{"point", point_name(point.method, point.knobs)},
          {"method", point.method},
          {"knobs", knobs_json(point.knobs)},
          {"bytes", point.bytes},
          {"errors", metrics}};
}

Json group_json(const Group& group, const GroupResult& result) {
  Json metrics = Json::list(), points = Json::list();
  for (const Metric& metric : group.metrics)
    metrics.push_back(
        {{"name", metric.name}, {"label", metric.label}, {"unit", metric.unit}, {"mean", name_of(metric.mean)}});
  for (const PointResult& point : result.points) points.push_back(point_json(group, point));
  return {{"name", group.name},   {"title", group.title}, {"truth", group.truth}, {"item", group.item},
          {"floor", group.floor}, {"metrics", metrics},   {"points", points}};
}

Json plot_json(const Plot& plot) {
  Json curves = Json::list();
  for (const Curve& curve : plot.curves)
    curves.push_back({{"name", curve.name}, {"x", curve.x}, {"y", curve.y}, {"marks", curve.marks}});
  return {{"name", plot.name},
          {"title", plot.title},
          {"x_label", plot.x_label},
          {"y_label", plot.y_label},
          {"polar", plot.polar},
          {"logarithmic", plot.logarithmic},
          {"logarithmic_x", plot.logarithmic_x},
          {"logarithmic_y", plot.logarithmic_y},
          {"curves", curves}};
}

/// Five digits: a grid is looked at.
Json grid_json(const Grid& grid) {
  Json values = Json::list();
  for (const std::vector<double>& row : grid.values) {
    Json numbers = Json::list();
    for (double value : row) numbers.push_back(std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr));
    values.push_back(std::move(numbers));
  }
  return {{"name", grid.name},
          {"title", grid.title},
          {"x_label", grid.x_label},
          {"y_label", grid.y_label},
          {"z_label", grid.z_label},
          {"x", grid.x},
          {"y", grid.y},
          {"values", values}};
}

Json table_json(const Table& table) {
  Json rows = Json::list();
  for (const auto& row : table.rows) rows.push_back(Json(row));
  return {{"name", table.name}, {"title", table.title}, {"columns", table.columns}, {"rows", rows}};
}

/// Names of all knobs of a study, in the order in which they come.
std::vector<std::string> knob_names(const StudyResult& result) {
  std::vector<std::string> names;
  for (const GroupResult& group : result.groups)
    for (const PointResult& point : group.points)
      for (const Knob& knob : point.knobs)
        if (std::ranges::find(names, knob.name) == names.end()) names.push_back(knob.name);
  return names;
}

std::string cell(const std::vector<Knob>& knobs, const std::string& name) {
  const auto found = std::ranges::find(knobs, name, &Knob::name);
  if (found == knobs.end()) return "";
  return found->value.find_first_of(",\"") == std::string::npos ? found->value : fmt::format("\"{}\"", found->value);
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string(); }

}  // namespace

Json result_json(const Study& study, const StudyResult& result, const std::string& command) {
  Json groups = Json::list(), plots = Json::list(), grids = Json::list(), tables = Json::list(),
       pictures = Json::list();
  for (std::size_t g = 0; g < study.groups.size(); ++g) groups.push_back(group_json(study.groups[g], result.groups[g]));
  for (const Plot& plot : study.plots) plots.push_back(plot_json(plot));
  for (const Grid& grid : study.grids) grids.push_back(grid_json(grid));
  for (const Table& table : study.tables) tables.push_back(table_json(table));
  for (const StudyPicture& picture : study.pictures)
    pictures.push_back({{"file", picture.file}, {"title", picture.title}, {"beside", picture.beside}});
  return {{"name", study.name},
          {"title", study.title},
          {"question", study.question},
          {"command", command},
          {"cost_label", study.cost_label},
          {"groups", groups},
          {"plots", plots},
          {"grids", grids},
          {"tables", tables},
          {"pictures", pictures},
          {"notes", study.notes}};
}

Json times_json(const Study& study, const StudyResult& result) {
  Json groups = Json::list();
  for (std::size_t g = 0; g < study.groups.size(); ++g) {
    Json points = Json::list();
    for (const PointResult& point : result.groups[g].points) {
      if (!point.time.is_timed()) continue;
      points.push_back({{"point", point_name(point.method, point.knobs)},
                        {"seconds", interval_json(point.time.seconds)},
                        {"kernels", interval_json(point.time.units)},
                        {"samples", point.time.samples},
                        {"calls", point.time.calls}});
    }
    groups.push_back({{"name", study.groups[g].name}, {"points", points}});
  }
  return {{"name", study.name},
          {"machine", machine_json(study.device, study.driver)},
          {"clock", study.wall_clock ? "wall clock" : "processor time of the process"},
          {"kernel", k_kernel},
          {"kernel_seconds", interval_json(result.kernel_seconds)},
          {"groups", groups}};
}

std::string result_csv(const Study& study, const StudyResult& result) {
  const std::vector<std::string> knobs = knob_names(result);
  std::string text = "group,method";
  for (const std::string& name : knobs) text += fmt::format(",{}", name);
  text += ",metric,mean_error,low,high,median_error,p95_error,p99_error,max_error,choosing_error,judging_error,bytes\n";
  for (std::size_t g = 0; g < study.groups.size(); ++g)
    for (const PointResult& point : result.groups[g].points)
      for (std::size_t m = 0; m < point.metrics.size(); ++m) {
        const MetricResult& metric = point.metrics[m];
        text += fmt::format("\"{}\",\"{}\"", study.groups[g].name, point.method);
        for (const std::string& name : knobs) text += fmt::format(",{}", cell(point.knobs, name));
        text += fmt::format(",{}", study.groups[g].metrics[m].name);
        for (double value : {metric.all.mean.value, metric.all.mean.low, metric.all.mean.high, metric.all.median,
                             metric.all.percentile_95, metric.all.percentile_99, metric.all.maximum,
                             metric.choosing.mean.value, metric.judging.mean.value, point.bytes})
          text += fmt::format(",{}", number(value));
        text += "\n";
      }
  return text;
}

Result<void> write_study(const Study& study, const StudyResult& result, const std::string& command,
                         const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  for (const StudyPicture& picture : study.pictures)
    CUTICLE_TRY(write_png(fmt::format("{}/{}", folder, picture.file), picture.image));
  CUTICLE_TRY(write_text_file(folder + "/times.json", times_json(study, result).dump(1) + "\n"));
  CUTICLE_TRY(write_text_file(folder + "/conclusions.json", conclusions_json(study, result).dump(1) + "\n"));
  CUTICLE_TRY(write_text_file(folder + "/study.csv", result_csv(study, result)));
  return write_text_file(folder + "/result.json", result_json(study, result, command).dump(1) + "\n");
}

}  // namespace cuticle::study
