#include "study/lobes/lobes_study.h"

#include <algorithm>

#include <fmt/core.h>

namespace cuticle::study {
namespace {

Result<std::vector<const bsdf::Model*>> chosen_models(const LobesRequest& request) {
  const auto all = bsdf::models();
  if (request.models.empty()) return std::vector<const bsdf::Model*>(all.begin(), all.end());
  std::vector<const bsdf::Model*> chosen;
  for (const std::string& name : request.models) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    chosen.push_back(model);
  }
  return chosen;
}

Table landmark_table(const Landmarks& landmarks) {
  Table table{"landmarks", "Places that the literature names", {"model", "what", "expected, degrees", "measured, degrees"}, {}};
  for (const Landmark& mark : landmarks.places)
    table.rows.push_back({mark.model, mark.what, fmt::format("{:.3f}", mark.expected), fmt::format("{:.3f}", mark.measured)});
  return table;
}

void add_all(std::vector<Plot>& plots, std::vector<Plot> more) {
  for (Plot& plot : more)
    if (!plot.curves.empty()) plots.push_back(std::move(plot));
}

Result<void> add_model(Study& study, Plot& albedo, const bsdf::Model& model, const LobesRequest& request) {
  const bsdf::FibreMapping mapping = settings_of(model, request.fibre);
  study.notes.push_back(fmt::format("{}: {} ({})", model.entry.name, mapping.settings, mapping.words));
  CUTICLE_ASSIGN(std::vector<Group> groups, tier_groups(model, mapping.settings, request));
  std::ranges::move(groups, std::back_inserter(study.groups));
  const std::string shown = shown_settings(model, mapping.settings, 12 * request.samples);
  CUTICLE_ASSIGN(std::vector<Plot> plots, lobe_plots(model, shown, request.samples));
  add_all(study.plots, std::move(plots));
  CUTICLE_ASSIGN(Grid grid, lobe_grid(model, mapping.settings, std::min<std::size_t>(request.samples / 2 + 1, 73)));
  study.grids.push_back(std::move(grid));
  CUTICLE_ASSIGN(Curve curve, albedo_curve(model, shown, std::min<std::size_t>(request.samples / 3 + 1, 61)));
  albedo.curves.push_back(std::move(curve));
  if (model.entry.name != "marschner") return {};
  CUTICLE_ASSIGN(Landmarks landmarks, landmarks_of(model, mapping.settings, request.samples));
  study.tables.push_back(landmark_table(landmarks));
  add_all(study.plots, std::move(landmarks.plots));
  return {};
}

}  // namespace

bsdf::FibreMapping settings_of(const bsdf::Model& model, const bsdf::Fibre& fibre) {
  return model.from_fibre ? model.from_fibre(fibre) : bsdf::FibreMapping{"", "no mapping: the defaults"};
}

Result<Study> lobes_study(const LobesRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<const bsdf::Model*> models, chosen_models(request));
  Study study{.name = "lobes",
              .title = fmt::format("Fibre models on {} hair", request.fibre_name),
              .question = "Which tier and precision of a fibre model is exact enough, and what does it cost?",
              .cost_label = "one evaluation of S, one thread"};
  CUTICLE_ASSIGN(study.groups.emplace_back(), across_models(models, request));
  Plot albedo{"albedo", "albedo of all models", "theta_o, degrees", "albedo (green)"};
  for (std::size_t i = 0; i < models.size(); ++i) {
    progress.update("models", i, models.size());
    CUTICLE_TRY(add_model(study, albedo, *models[i], request));
  }
  progress.update("models", models.size(), models.size());
  study.plots.push_back(std::move(albedo));
  return study;
}

}  // namespace cuticle::study
