// The study of drawing as files: pictures, CSV, and the JSON that pages are made from.
#include <map>

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/json.h"
#include "study/demo/demo_page.h"
#include "study/render/render_study.h"

namespace cuticle::study {

namespace {

Json row_json(const RenderRow& row) {
  return {{"method", row.method},
          {"view", row.view},
          {"settings", row.settings},
          {"mean_error", row.error.coverage},
          {"p95_error", row.error.p95_coverage},
          {"max_error", row.error.max_coverage},
          {"bias", row.error.coverage_bias},
          {"color_error", row.error.color},
          {"total_ms", row.ms},
          {"bytes", row.bytes}};
}

std::string words_of(const RenderStudy& study) {
  return fmt::format(
      "Scene: {}; the hair alone. Truth: every sample of {} x {} in a pixel with all strands that cover it, "
      "sorted exactly. "
      "Coverage errors are means over the pixels that hair covers in either picture. Times: a frame's whole "
      "submission, wall clock, on {}; of 'truth' the work of the CPU too.",
      study.scene, study.truth_samples, study.truth_samples, study.device);
}

/// Which setting is cheapest for a wanted error.
Json choices(const RenderStudy& study) {
  Json words = Json::list({words_of(study)});
  for (const RenderView& view : study.views)
    for (double error : {0.2, 0.1, 0.07, 0.05, 0.03, 0.01}) {
      const RenderRow* row = cheapest(study.rows, view.name, error);
      words.push_back(row ? fmt::format("{}, error at most {}: {} {} in {:.1f} ms (error {:.4f}).", view.name, error,
                                        row->method, row->settings, row->ms, row->error.coverage)
                          : fmt::format("{}, error at most {}: no setting.", view.name, error));
    }
  return words;
}

Json growth_plots(const RenderStudy& study) {
  std::map<std::string, std::map<std::string, std::pair<Json, Json>>> curves;
  for (const GrowthRow& row : study.growth) {
    auto& [x, y] = curves[row.size].try_emplace(row.method, Json::list(), Json::list()).first->second;
    x.push_back(row.factor);
    y.push_back(row.ms);
  }
  Json plots = Json::list();
  for (const auto& [size, methods] : curves) {
    Json lines = Json::list();
    for (const auto& [method, points] : methods)
      lines.push_back({{"name", method}, {"x", points.first}, {"y", points.second}});
    plots.push_back({{"name", "growth_" + size},
                     {"title", "A frame's cost as the scene's " + size + " grow"},
                     {"x_label", size + ", times the scene's"},
                     {"y_label", "a frame, ms"},
                     {"logarithmic", true},
                     {"polar", false},
                     {"curves", lines}});
  }
  return plots;
}

std::string growth_csv(const RenderStudy& study) {
  std::string text = "size,method,factor,ms\n";
  for (const GrowthRow& row : study.growth)
    text += fmt::format("{},{},{},{:.2f}\n", row.size, row.method, row.factor, row.ms);
  return text;
}

Json study_json(const RenderStudy& study) {
  Json rows = Json::list();
  for (const RenderRow& row : study.rows) rows.push_back(row_json(row));
  return {{"name", "render"},
          {"title", "Ways to draw hair against brute force"},
          {"x", {{"key", "total_ms"}, {"label", "a frame, ms"}, {"scale", "log"}}},
          {"y", {{"key", "mean_error"}, {"label", "mean error of coverage"}, {"scale", "log"}}},
          {"series", "view"},
          {"label", "settings"},
          {"words", choices(study)},
          {"plots", growth_plots(study)},
          {"baselines", Json::list()},
          {"rows", rows}};
}

DemoSection section_of(const RenderView& view, const std::string& file) {
  std::string titles;
  for (const std::string& title : view.titles) titles += (titles.empty() ? "" : ", ") + title;
  return {fmt::format("The view: {}", view.name),
          "Below: coverage that is missing in red, too much in green, four times as bright as it is.",
          {{file, titles}},
          {}};
}

}  // namespace

std::string to_csv(const RenderStudy& study) {
  std::string text = "view,method,settings,mean_error,p95_error,max_error,bias,color_error,total_ms,bytes\n";
  for (const RenderRow& row : study.rows)
    text += fmt::format("{},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.2f},{}\n", row.view, row.method, row.settings,
                        row.error.coverage, row.error.p95_coverage, row.error.max_coverage, row.error.coverage_bias,
                        row.error.color, row.ms, row.bytes);
  return text;
}

Result<void> write_render_study(const RenderStudy& study, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder + "/study"));
  DemoPage page{"Ways to draw hair", {}};
  for (std::size_t k = 0; k < study.views.size(); ++k) {
    const std::string file = fmt::format("view_{}.png", k);
    const RenderView& view = study.views[k];
    CUTICLE_TRY(write_png(folder + "/" + file, contact_sheet(view.pictures, int(view.titles.size()))));
    page.sections.push_back(section_of(view, file));
  }
  CUTICLE_TRY(write_text_file(folder + "/study/study.json", study_json(study).dump(2)));
  CUTICLE_TRY(write_text_file(folder + "/study/study.csv", to_csv(study)));
  if (!study.growth.empty()) CUTICLE_TRY(write_text_file(folder + "/study/growth.csv", growth_csv(study)));
  return write_page(page, folder);
}

}  // namespace cuticle::study
