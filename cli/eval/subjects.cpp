#include "cli/eval/subjects.h"

#include <fmt/core.h>

#include "bsdf/fibre/fibres.h"
#include "bsdf/materialx/materialx.h"
#include "cli/command.h"

namespace cuticle::cli {
namespace {

Result<std::vector<const bsdf::Model*>> named_models(const std::string& names) {
  const auto all = bsdf::models();
  if (names == "all") return std::vector<const bsdf::Model*>(all.begin(), all.end());
  std::vector<const bsdf::Model*> chosen;
  for (const std::string& name : split_list(names)) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    chosen.push_back(model);
  }
  return chosen;
}

/// The model's parameters: `over` goes over those of the mapping.
Result<Subject> mapped_subject(const bsdf::Model& model, bsdf::FibreMapping mapping, const std::string& over) {
  const std::string both = over.empty() ? mapping.settings : fmt::format("{},{}", mapping.settings, over);
  CUTICLE_ASSIGN(registry::ParameterValues values, bsdf::parse_settings(model, "", both));
  return Subject{&model, std::move(values), std::move(mapping)};
}

Result<std::vector<Subject>> subjects_of_hair(const std::vector<const bsdf::Model*>& models,
                                              const SubjectRequest& request) {
  CUTICLE_ASSIGN(const bsdf::NamedFibre hair, bsdf::find_fibre(request.hair));
  std::vector<Subject> subjects;
  for (const bsdf::Model* model : models) {
    if (!model->from_fibre && request.models == "all") continue;
    if (!model->from_fibre)
      return usage_error(fmt::format("model {} has no mapping from a hair", model->entry.name), "--set name=value,...");
    CUTICLE_ASSIGN(Subject subject, mapped_subject(*model, model->from_fibre(hair.fibre), request.settings));
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

Result<std::vector<Subject>> subjects_of_material(const std::vector<const bsdf::Model*>& models,
                                                  const SubjectRequest& request) {
  CUTICLE_ASSIGN(bsdf::FibreMapping mapping, bsdf::read_materialx(request.material));
  if (models.size() != 1 || models[0]->entry.name != "chiang")
    return usage_error("--material gives the parameters of the model chiang", "--model chiang");
  CUTICLE_ASSIGN(Subject subject, mapped_subject(*models[0], std::move(mapping), request.settings));
  return std::vector<Subject>{std::move(subject)};
}

Result<void> check_sources(const SubjectRequest& request) {
  const int given = !request.preset.empty() + !request.hair.empty() + !request.material.empty();
  if (given > 1) return usage_error("--preset, --hair and --material exclude each other");
  return {};
}

Result<std::vector<Subject>> plain_subjects(const std::vector<const bsdf::Model*>& models,
                                            const SubjectRequest& request) {
  std::vector<Subject> subjects;
  for (const bsdf::Model* model : models) {
    CUTICLE_ASSIGN(registry::ParameterValues values, bsdf::parse_settings(*model, request.preset, request.settings));
    subjects.push_back({model, std::move(values), std::nullopt});
  }
  return subjects;
}

Result<std::vector<Subject>> subjects_before_absorption(const SubjectRequest& request) {
  CUTICLE_TRY(check_sources(request));
  CUTICLE_ASSIGN(const std::vector<const bsdf::Model*> models, named_models(request.models));
  if (!request.hair.empty()) return subjects_of_hair(models, request);
  if (!request.material.empty()) return subjects_of_material(models, request);
  return plain_subjects(models, request);
}

}  // namespace

Result<std::vector<Subject>> choose_subjects(const SubjectRequest& request) {
  CUTICLE_ASSIGN(std::vector<Subject> subjects, subjects_before_absorption(request));
  for (Subject& subject : subjects) CUTICLE_TRY(apply_absorption(request.absorption, *subject.model, subject.values));
  return subjects;
}

std::array<bool, bsdf::coordinate_count> needed_coordinates(const std::vector<Subject>& subjects,
                                                            bsdf::Quantity quantity) {
  std::array<bool, bsdf::coordinate_count> needed{};
  for (const Subject& subject : subjects) {
    const auto used = bsdf::coordinates_of(*subject.model, subject.values, quantity);
    for (std::size_t c = 0; c < used.size(); ++c) needed[c] = needed[c] || used[c];
  }
  return needed;
}

}  // namespace cuticle::cli
