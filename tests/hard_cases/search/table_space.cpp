// Tables of every layout, of any model that it takes: what a file stores is finite wherever it is looked up.
#include <algorithm>
#include <span>
#include <string_view>

#include "bsdf/model.h"
#include "lut/evaluate.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr int k_texels = 16;
constexpr double k_largest_stored = 1e38;

/// Tables have no axis for the offset in a fibre; an axis from the caustic wants a fibre with one.
constexpr std::string_view k_kept_in_tables[] = {"field", "variant", "aspect", "caustic"};

std::span<const std::string_view> kept_by(const lut::Layout& layout) {
  const bool is_from_caustic = std::ranges::any_of(
      layout.tables, [](const lut::TableLayout& table) { return table.u.quantity == lut::AxisQuantity::from_caustic; });
  return std::span(k_kept_in_tables).first(is_from_caustic ? 4 : 1);
}

/// The model's defaults as seen from afar.
std::string far_settings(const bsdf::Model& model) {
  const registry::ParameterValues usual = registry::default_values(model.entry.parameters);
  return model.near_field && model.near_field(usual) ? "field=far" : "";
}

bool takes(const lut::Layout& layout, const bsdf::Model& model) {
  const auto values = registry::parse_assignments(model.entry.parameters, far_settings(model));
  return values && lut::check_bakeable(lut::cpu_source(model, *values), *values, layout).ok();
}

/// All that the layout takes but `huang`, whose tables take minutes by walks.
std::vector<const bsdf::Model*> baked_models(const lut::Layout& layout) {
  std::vector<const bsdf::Model*> models(bsdf::models().begin(), bsdf::models().end());
  std::erase_if(models,
                [&](const bsdf::Model* model) { return model->entry.name == "huang" || !takes(layout, *model); });
  return models;
}

/// Settings of the coordinates, as seen from afar.
std::string far_settings_at(Coordinates& at, const bsdf::Model& model, const lut::Layout& layout) {
  const std::string far = far_settings(model), set = at.settings(model.entry.parameters, kept_by(layout));
  return far + (far.empty() || set.empty() ? "" : ",") + set;
}

std::size_t most_parameters(std::span<const bsdf::Model* const> models) {
  std::size_t most = 0;
  for (const bsdf::Model* model : models) most = std::max(most, model->entry.parameters.size());
  return most;
}

/// A layout's table and one of its channels.
void choose_channel(const lut::Layout& layout, Coordinates& at, Json& inputs) {
  const lut::TableLayout& table = layout.tables[at.below(layout.tables.size())];
  inputs["table"] = table.name;
  inputs["channel"] = table.channels[at.below(table.channels.size())].name;
}

Json table_case(const lut::Layout& layout, std::span<const bsdf::Model* const> models, const Place& place) {
  Coordinates at(place);
  const bsdf::Model& model = *models[at.below(models.size())];
  Json inputs{{"model", model.entry.name}, {"layout", layout.entry.name}, {"size", k_texels}};
  choose_channel(layout, at, inputs);
  for (const char* axis : {"u", "v"}) inputs[axis] = Json::list({0, at.next(), 1});
  inputs["set"] = far_settings_at(at, model, layout);
  return Json{{"subject", "lut"},
              {"inputs", std::move(inputs)},
              {"expect", Json{{"bounds", Json::list({-k_largest_stored, k_largest_stored})}}}};
}

}  // namespace

std::vector<Space> table_spaces() {
  std::vector<Space> all;
  for (const lut::Layout* layout : lut::layouts()) {
    const std::vector<const bsdf::Model*> models = baked_models(*layout);
    all.push_back({.name = "table_" + std::string(layout->entry.name),
                   .size = 5 + most_parameters(models),
                   .case_at = [layout, models](const Place& place) { return table_case(*layout, models, place); },
                   .climbs = 0,
                   .steps = 6});
  }
  return all;
}

}  // namespace cuticle::hard_cases::search
