// Tables of every layout, of any model that it takes: what a file stores is finite wherever it is looked up.
#include <algorithm>

#include "bsdf/model.h"
#include "lut/table_set.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr int k_texels = 16;
constexpr double k_largest_stored = 1e38;

/// All but `huang`, whose tables take minutes by walks.
std::vector<const bsdf::Model*> baked_models() {
  std::vector<const bsdf::Model*> models(bsdf::models().begin(), bsdf::models().end());
  std::erase_if(models, [](const bsdf::Model* model) { return model->entry.name == "huang"; });
  return models;
}

std::size_t most_parameters() {
  std::size_t most = 0;
  for (const bsdf::Model* model : baked_models()) most = std::max(most, model->entry.parameters.size());
  return most;
}

/// A layout's table and one of its channels.
void choose_channel(const lut::Layout& layout, Coordinates& at, Json& inputs) {
  const lut::TableLayout& table = layout.tables[at.below(layout.tables.size())];
  inputs["table"] = table.name;
  inputs["channel"] = table.channels[at.below(table.channels.size())].name;
}

Json table_case(const lut::Layout& layout, const Place& place) {
  Coordinates at(place);
  const std::vector<const bsdf::Model*> models = baked_models();
  const bsdf::Model& model = *models[at.below(models.size())];
  Json inputs{{"model", model.entry.name}, {"layout", layout.entry.name}, {"size", k_texels}};
  choose_channel(layout, at, inputs);
  for (const char* axis : {"u", "v"}) inputs[axis] = Json::list({0, at.next(), 1});
  inputs["set"] = at.settings(model.entry.parameters);
  return Json{{"subject", "lut"},
              {"inputs", std::move(inputs)},
              {"expect", Json{{"bounds", Json::list({-k_largest_stored, k_largest_stored})}}}};
}

}  // namespace

std::vector<Space> table_spaces() {
  std::vector<Space> all;
  for (const lut::Layout* layout : lut::layouts())
    all.push_back({.name = "table_" + std::string(layout->entry.name),
                   .size = 5 + most_parameters(),
                   .case_at = [layout](const Place& place) { return table_case(*layout, place); },
                   .climbs = 0,
                   .steps = 6});
  return all;
}

}  // namespace cuticle::hard_cases::search
