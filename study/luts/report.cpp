// The study's rows as JSON, CSV and sentences.
#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/file.h"
#include "core/json/json.h"
#include "study/luts/luts_study.h"

namespace cuticle::study {
namespace {

/// The set of the model with the least error of S among those that take less than so many ns; null: none does.
const LutRow* most_exact_below(const LutsStudy& study, std::string_view model, double ns) {
  const LutRow* best = nullptr;
  for (const LutRow& row : study.rows)
    if (row.model == model && row.channel == "S" && row.ns < ns && (!best || row.rms_error < best->rms_error))
      best = &row;
  return best;
}

std::string set_name(const LutRow& row) {
  return fmt::format("{} {} x {} {}{}", row.layout, row.size, row.size, row.format,
                     row.fit == "none" ? "" : ", fitted");
}

/// The tables of a model beside one way to evaluate it.
std::string verdict(const LutsStudy& study, const DirectRow& direct, const LutRow& best) {
  const std::string itself =
      fmt::format("{}, {}: {:.0f} ns with an error of {:.1e}", direct.model, direct.path, direct.ns, direct.rms_error);
  const LutRow* cheaper = most_exact_below(study, direct.model, direct.ns);
  if (!cheaper) return itself + ": cheaper and more exact than every table here; no table is worth it.";
  const std::string offer = fmt::format(
      "{}. The most exact set of tables that is cheaper, {}, takes {:.0f} ns and {} bytes "
      "and is off by {:.1e}: worth it where that will do",
      itself, set_name(*cheaper), cheaper->ns, cheaper->bytes, cheaper->rms_error);
  if (cheaper == &best) return offer + ".";
  return offer + "; below that error the model itself is cheaper and more exact.";
}

Json row_json(const LutRow& row) {
  return {{"method", row.model + ", " + row.layout + (row.fit == "none" ? "" : ", fitted")},
          {"model", row.model},
          {"layout", row.layout},
          {"size", row.size},
          {"format", row.format},
          {"fit", row.fit},
          {"lobe", row.channel},
          {"settings", fmt::format("{} {} {} {}", row.layout, row.size, row.format, row.fit)},
          {"rms_error", row.rms_error},
          {"p99_error", row.p99_error},
          {"max_error", row.max_error},
          {"ns", row.ns},
          {"bytes", row.bytes},
          {"bake_ms", row.bake_ms}};
}
Json row_json(const DirectRow& row) {
  return {{"method", row.model + ", direct"},
          {"model", row.model},
          {"format", row.path},
          {"size", row.path},
          {"lobe", row.lobe},
          {"settings", row.path},
          {"ns", row.ns},
          {"rms_error", row.rms_error},
          {"bytes", 0}};
}

/// Error of each channel against bytes: a plot for each model, a curve for each layout, format and fit.
Json plots_of(const LutsStudy& study) {
  std::map<std::pair<std::string, std::string>, std::map<std::string, std::map<std::size_t, double>>> plots;
  for (const LutRow& row : study.rows)
    plots[{row.model, row.channel}][fmt::format("{} {}{}", row.layout, row.format, row.fit == "none" ? "" : " fitted")]
         [row.bytes] = row.rms_error;
  Json all = Json::list();
  for (const auto& [key, curves] : plots) {
    Json plot = {{"name", fmt::format("bytes_{}_{}", key.first, key.second)},
                 {"title", fmt::format("{}: error of {} against bytes of the set", key.first, key.second)},
                 {"x_label", "bytes"},
                 {"y_label", "rms error / rms of the signal"},
                 {"polar", false},
                 {"logarithmic", true},
                 {"curves", Json::list()}};
    for (const auto& [name, points] : curves) {
      Json curve = {{"name", name}, {"x", Json::list()}, {"y", Json::list()}};
      for (const auto& [bytes, error] : points) {
        curve["x"].push_back(bytes);
        curve["y"].push_back(std::max(error, 1e-9));
      }
      plot["curves"].push_back(std::move(curve));
    }
    all.push_back(std::move(plot));
  }
  return all;
}

}  // namespace

std::vector<std::string> verdicts_of(const LutsStudy& study) {
  std::vector<std::string> sentences;
  for (const DirectRow& direct : study.direct) {
    const LutRow* best = most_exact_below(study, direct.model, std::numeric_limits<double>::infinity());
    if (direct.lobe == "S" && direct.path != "double" && best) sentences.push_back(verdict(study, direct, *best));
  }
  return sentences;
}

std::string to_json(const LutsStudy& study) {
  Json json{{"name", "luts"}, {"title", "Lookup tables beside the model they stand for: error, bytes and time"}};
  json["x"] = {{"key", "ns"}, {"label", "ns for one S, one CPU thread"}, {"scale", "log"}};
  json["y"] = {{"key", "rms_error"}, {"label", "rms error of S / rms of S"}, {"scale", "log"}};
  json["series"] = "format";
  json["pareto"] = true;
  json["label"] = "size";
  json["words"] = study.verdicts;
  json["words"].push_back(
      "Errors are those of the engine's bilinear filter in the stored format. Times are of float code on one CPU "
      "thread, "
      "tables in cache: a GPU's texture units are not what is measured.");
  for (const std::string& skipped : study.skipped) json["words"].push_back("Left out: " + skipped);
  json["baselines"] = Json::list();
  json["rows"] = Json::list();
  for (const DirectRow& row : study.direct)
    if (row.lobe == "S" && row.rms_error > 0) json["rows"].push_back(row_json(row));
  for (const LutRow& row : study.rows)
    if (row.channel == "S") json["rows"].push_back(row_json(row));
  json["channels"] = Json::list();
  for (const DirectRow& row : study.direct) json["channels"].push_back(row_json(row));
  for (const LutRow& row : study.rows) json["channels"].push_back(row_json(row));
  json["plots"] = plots_of(study);
  json["landmarks"] = Json::list();
  return json.dump(2) + "\n";
}

std::string to_csv(const LutsStudy& study) {
  std::string text = "model,layout,size,format,fit,channel,rms_error,p99_error,max_error,bytes,ns,bake_ms\n";
  for (const DirectRow& row : study.direct)
    text +=
        fmt::format("{},direct,,\"{}\",,{},{:.3g},,,0,{:.4g},\n", row.model, row.path, row.lobe, row.rms_error, row.ns);
  for (const LutRow& row : study.rows)
    text += fmt::format("{},{},{},{},{},{},{:.3g},{:.3g},{:.3g},{},{:.4g},{:.4g}\n", row.model, row.layout, row.size,
                        row.format, row.fit, row.channel, row.rms_error, row.p99_error, row.max_error, row.bytes,
                        row.ns, row.bake_ms);
  return text;
}

Result<void> write_luts_study(const LutsStudy& study, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_text_file(folder + "/study.csv", to_csv(study)));
  return write_text_file(folder + "/study.json", to_json(study));
}

}  // namespace cuticle::study
