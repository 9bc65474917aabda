#include "bsdf/listing/listing.h"

#include "bsdf/model.h"
#include "core/json/json.h"

namespace cuticle::bsdf {
namespace {

Json conventions_json(const Conventions& conventions) {
  return {{"field", conventions.field},
          {"cosine", conventions.cosine},
          {"tilt_sign", conventions.tilt_sign},
          {"roughness", conventions.roughness},
          {"absorption", conventions.absorption}};
}

Json presets_json(const Model& model) {
  Json presets = Json::list();
  for (const registry::StudyCase& preset : model.presets)
    presets.push_back({{"name", preset.name}, {"settings", preset.settings}});
  return presets;
}

Json exceptions_json(const Model& model) {
  Json exceptions = Json::list();
  for (const Exception& exception : model.exceptions)
    exceptions.push_back({{"check", exception.check}, {"why", exception.why}, {"when", exception.when}});
  return exceptions;
}

void add_model(Json& object, const Model& model) {
  object["lobes"] = Json::list();
  for (std::string_view lobe : model.lobes) object["lobes"].push_back(lobe);
  object["conventions"] = conventions_json(model.conventions);
  object["presets"] = presets_json(model);
  object["exceptions"] = exceptions_json(model);
  object["maps_a_hair"] = model.from_fibre != nullptr;
  object["samples"] = model.sample_f64 != nullptr;
  object["near_field"] = model.near_field && model.near_field(registry::default_values(model.entry.parameters));
}

}  // namespace

std::string models_json() {
  std::vector<const registry::Entry*> entries;
  for (const Model* model : models()) entries.push_back(&model->entry);
  Json list = Json::parse(registry::to_json(entries)).value();
  for (std::size_t i = 0; i < list.size(); ++i) add_model(list[i], *models()[i]);
  return list.dump(2);
}

}  // namespace cuticle::bsdf
