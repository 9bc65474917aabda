#include <cuticle/bsdf/listing/listing.h>

#include <nlohmann/json.hpp>

#include <cuticle/bsdf/model.h>

namespace cuticle::bsdf {
namespace {

using nlohmann::json;

json conventions_json(const Conventions& conventions) {
  return {{"field", conventions.field},
          {"cosine", conventions.cosine},
          {"tilt_sign", conventions.tilt_sign},
          {"roughness", conventions.roughness},
          {"absorption", conventions.absorption}};
}

json presets_json(const Model& model) {
  json presets = json::array();
  for (const registry::StudyCase& preset : model.presets)
    presets.push_back({{"name", preset.name}, {"settings", preset.settings}});
  return presets;
}

json exceptions_json(const Model& model) {
  json exceptions = json::array();
  for (const Exception& exception : model.exceptions)
    exceptions.push_back({{"check", exception.check}, {"why", exception.why}, {"when", exception.when}});
  return exceptions;
}

void add_model(json& object, const Model& model) {
  object["lobes"] = json::array();
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
  json list = json::parse(registry::to_json(entries));
  for (std::size_t i = 0; i < list.size(); ++i) add_model(list[i], *models()[i]);
  return list.dump(2);
}

}  // namespace cuticle::bsdf
