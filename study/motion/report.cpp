#include <algorithm>

#include <fmt/format.h>

#include "core/file.h"
#include "core/json/json.h"
#include "study/motion/motion_study.h"

namespace cuticle::study {
namespace {

std::string curve_name(const MotionRow& row) {
  return row.solver == "classic" ? fmt::format("classic, {} sweeps", row.iterations) : row.solver;
}

std::vector<std::string> scenes_of(const MotionStudy& study) {
  std::vector<std::string> scenes;
  for (const MotionRow& row : study.rows)
    if (scenes.empty() || scenes.back() != row.scene) scenes.push_back(row.scene);
  return scenes;
}

std::string verdict(const MotionStudy& study, const std::string& scene) {
  const double change = study.reference_change.at(scene);
  std::string words = fmt::format("{} (half of the reference's substeps change it by {:.1e}):", scene, change);
  for (double error : {0.1, 0.03, 0.01, 0.003}) {
    if (change > error) {
      words += fmt::format(" {} %: the reference is not known so well;", 100 * error);
      continue;
    }
    const MotionRow* row = cheapest(study, scene, error);
    words += row ? fmt::format(" {} % of the length: {} with {} substeps, {:.3g} us;", 100 * error, curve_name(*row),
                               row->substeps, row->us)
                 : fmt::format(" {} %: none;", 100 * error);
  }
  words.back() = '.';
  return words;
}

Json row_json(const MotionRow& row) {
  return {{"method", row.scene + ", " + curve_name(row)},
          {"settings", fmt::format("{} substeps", row.substeps)},
          {"substeps", row.substeps},
          {"us", row.us},
          {"early_error", row.early_error},
          {"error", row.error},
          {"largest_stretch", row.largest_stretch}};
}

/// A case's errors after `early` (0.2 s) or 0.5 s against the cost, a curve for each solver.
Json plot_json(const MotionStudy& study, const std::string& scene) {
  Json curves = Json::list();
  for (const MotionRow& row : study.rows) {
    if (row.scene != scene) continue;
    if (auto known =
            std::find_if(curves.begin(), curves.end(), [&](const Json& c) { return c["name"] == curve_name(row); });
        known != curves.end()) {
      (*known)["x"].push_back(row.us);
      (*known)["y"].push_back(row.error);
    } else {
      curves.push_back({{"name", curve_name(row)}, {"x", Json::list({row.us})}, {"y", Json::list({row.error})}});
    }
  }
  std::string name = scene;
  std::replace(name.begin(), name.end(), ' ', '_');
  return {{"name", name},
          {"title", scene + ": after 0.5 s"},
          {"x_label", "us of processor time a frame and strand"},
          {"y_label", "rms distance from the reference over the length"},
          {"polar", false},
          {"logarithmic", true},
          {"curves", curves}};
}

/// Errors against closed forms by the step, a curve for each truth and solver.
Json truths_plot_json(const MotionStudy& study) {
  Json curves = Json::list();
  for (std::size_t begin = 0, end = 0; begin < study.truths.size(); begin = end) {
    const TruthRow& first = study.truths[begin];
    Json x = Json::list(), y = Json::list();
    for (; end < study.truths.size() && study.truths[end].truth == first.truth && study.truths[end].solver == first.solver;
         ++end) {
      x.push_back(study.truths[end].step);
      y.push_back(study.truths[end].error);
    }
    curves.push_back({{"name", fmt::format("{} ({})", first.truth, first.solver)}, {"x", x}, {"y", y}});
  }
  return {{"name", "truths"},
          {"title", "Closed forms of mechanics"},
          {"x_label", "time step, s"},
          {"y_label", "error"},
          {"polar", false},
          {"logarithmic", true},
          {"curves", curves}};
}

std::string to_json(const MotionStudy& study) {
  Json json{{"name", "motion"}, {"title", "Strand solvers: error against time"}};
  json["x"] = {{"key", "us"}, {"label", "us of processor time a frame (1/60 s) and strand"}, {"scale", "log"}};
  json["y"] = {
      {"key", "error"}, {"label", "rms distance from the reference over the length, after 0.5 s"}, {"scale", "log"}};
  json["series"] = "";
  json["label"] = "substeps";
  json["pareto"] = false;  // the cases are not alternatives
  Json words = Json::list();
  words.push_back(
      "Cheapest solver for an error after 0.5 s, rms distance over the length, in a frame of 1/60 s and per strand:");
  for (const std::string& scene : scenes_of(study)) words.push_back(verdict(study, scene));
  json["words"] = words;
  json["baselines"] = Json::list();
  json["plots"] = Json::list();
  for (const MotionRow& row : study.rows) json["rows"].push_back(row_json(row));
  for (const std::string& scene : scenes_of(study)) json["plots"].push_back(plot_json(study, scene));
  json["plots"].push_back(truths_plot_json(study));
  return json.dump(2) + "\n";
}

}  // namespace

std::string motion_csv(const MotionStudy& study) {
  std::string text = "scene,solver,substeps,iterations,early_error,error,largest_stretch,us\n";
  for (const MotionRow& row : study.rows)
    text += fmt::format("{},{},{},{},{:.4g},{:.4g},{:.6g},{:.4g}\n", row.scene, row.solver, row.substeps,
                        row.iterations, row.early_error, row.error, row.largest_stretch, row.us);
  return text;
}

std::string truths_csv(const MotionStudy& study) {
  std::string text = "truth,solver,step_s,error\n";
  for (const TruthRow& row : study.truths)
    text += fmt::format("\"{}\",{},{:.6g},{:.4g}\n", row.truth, row.solver, row.step, row.error);
  return text;
}

Result<void> write_motion_study(const MotionStudy& study, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_text_file(folder + "/study.csv", motion_csv(study)));
  CUTICLE_TRY(write_text_file(folder + "/truths.csv", truths_csv(study)));
  return write_text_file(folder + "/study.json", to_json(study));
}

}  // namespace cuticle::study
