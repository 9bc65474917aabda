#include "study/lobes/lobes_study.h"

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/json.h"

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

/// The fibre in the model's parameters; what it has no mapping for keeps the defaults, and the note says so.
bsdf::FibreMapping mapping_of(const bsdf::Model& model, const bsdf::Fibre& fibre) {
  return model.from_fibre ? model.from_fibre(fibre) : bsdf::FibreMapping{"", "no mapping: the defaults"};
}

Result<void> add_model(LobesStudy& study, Plot& albedo, const bsdf::Model& model, const LobesRequest& request) {
  const bsdf::FibreMapping mapping = mapping_of(model, request.fibre);
  study.notes.push_back(fmt::format("{}: {} ({})", model.entry.name, mapping.settings, mapping.words));
  CUTICLE_ASSIGN(const std::vector<TierRow> rows, compare_tiers(model, mapping.settings, request));
  study.rows.insert(study.rows.end(), rows.begin(), rows.end());
  const std::string finest = finest_settings(model, mapping.settings);
  CUTICLE_ASSIGN(const std::vector<Plot> plots, lobe_plots(model, finest, request.samples));
  study.plots.insert(study.plots.end(), plots.begin(), plots.end());
  CUTICLE_ASSIGN(Curve curve, albedo_curve(model, finest, std::min<std::size_t>(request.samples, 61)));
  albedo.curves.push_back(std::move(curve));
  if (model.entry.name != "marschner") return {};
  CUTICLE_ASSIGN(const Landmarks landmarks, landmarks_of(model, mapping.settings, request.samples));
  study.landmarks = landmarks.places;
  study.plots.insert(study.plots.end(), landmarks.plots.begin(), landmarks.plots.end());
  return {};
}

Json row_json(const TierRow& row) {
  return {
      {"method", row.model},        {"settings", row.settings},  {"tier", row.tier}, {"precision", row.precision},
      {"reference", row.reference}, {"points", row.points},      {"ns", row.ns},     {"median_error", row.median_error},
      {"p99_error", row.p99_error}, {"max_error", row.max_error}};
}

Json plot_json(const Plot& plot) {
  Json curves = Json::list();
  for (const Curve& curve : plot.curves) curves.push_back({{"name", curve.name}, {"x", curve.x}, {"y", curve.y}});
  return {{"name", plot.name},       {"title", plot.title}, {"x_label", plot.x_label},
          {"y_label", plot.y_label}, {"polar", plot.polar}, {"curves", curves}};
}

}  // namespace

Result<LobesStudy> run_lobes_study(const LobesRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<const bsdf::Model*> models, chosen_models(request));
  LobesStudy study;
  study.fibre_name = request.fibre_name;
  Plot albedo{"albedo", "albedo of all models", "theta_o, degrees", "albedo (green)", false, {}};
  for (std::size_t i = 0; i < models.size(); ++i) {
    progress.update("models", i, models.size());
    CUTICLE_TRY(add_model(study, albedo, *models[i], request));
  }
  progress.update("models", models.size(), models.size());
  study.plots.push_back(std::move(albedo));
  return study;
}

std::string to_json(const LobesStudy& study) {
  Json json{{"name", "lobes"},
            {"title", fmt::format("Fibre models on {} hair: error against time, and lobes", study.fibre_name)}};
  json["x"] = {{"key", "ns"}, {"label", "ns per evaluation of S, one thread"}, {"scale", "log"}};
  json["y"] = {{"key", "p99_error"}, {"label", "99th percentile of the relative error of S"}, {"scale", "log"}};
  json["series"] = "precision";
  json["label"] = "tier";
  json["words"] = study.notes;
  json["baselines"] = Json::list();
  for (const TierRow& row : study.rows) json["rows"].push_back(row_json(row));
  for (const Plot& plot : study.plots) json["plots"].push_back(plot_json(plot));
  json["landmarks"] = Json::list();
  for (const Landmark& mark : study.landmarks)
    json["landmarks"].push_back(
        {{"model", mark.model}, {"what", mark.what}, {"expected_deg", mark.expected}, {"measured_deg", mark.measured}});
  return json.dump(2) + "\n";
}

std::string to_csv(const LobesStudy& study) {
  std::string text = "model,tier,precision,reference,points,ns,median_error,p99_error,max_error,settings\n";
  for (const TierRow& row : study.rows)
    text += fmt::format("{},\"{}\",{},{},{},{:.4g},{:.3g},{:.3g},{:.3g},\"{}\"\n", row.model, row.tier, row.precision,
                        row.reference ? "yes" : "no", row.points, row.ns, row.median_error, row.p99_error,
                        row.max_error, row.settings);
  return text;
}

Result<void> write_lobes_study(const LobesStudy& study, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_text_file(folder + "/study.csv", to_csv(study)));
  return write_text_file(folder + "/study.json", to_json(study));
}

}  // namespace cuticle::study
