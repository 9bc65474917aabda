// Tables: {"model", "set", "layout", "size", "table", "channel"} sampled at every combination of "u" and "v".
// "format": how the f32 values are stored, "exr" unless given.

#include "core/json/json.h"
#include "lut/format.h"
#include "lut/table_set.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include "lut/bake_gpu.h"
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

struct Recipe {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  const lut::Layout* layout = nullptr;
  int size = 0;
};

Result<Recipe> recipe_from(const Json& inputs) {
  Recipe recipe;
  CUTICLE_ASSIGN(recipe.model, bsdf::find_model(inputs.at("model").text()));
  CUTICLE_ASSIGN(recipe.values,
                 registry::parse_assignments(recipe.model->entry.parameters, inputs.value("set", std::string())));
  CUTICLE_ASSIGN(recipe.layout, lut::find_layout(inputs.at("layout").text()));
  recipe.size = inputs.at("size").get<int>();
  return recipe;
}

Result<int> channel_index(const lut::TableLayout& table, const std::string& name) {
  for (std::size_t c = 0; c < table.channels.size(); ++c)
    if (table.channels[c].name == name) return int(c);
  return internal_error("unknown channel " + name);
}

Result<Values> sampled(const lut::TableSet& set, const Json& inputs) {
  for (const lut::Table& table : set.tables) {
    if (table.layout->name != inputs.at("table").text()) continue;
    CUTICLE_ASSIGN(const int channel, channel_index(*table.layout, inputs.at("channel").text()));
    Values values;
    for (double u : numbers(inputs.at("u")))
      for (double v : numbers(inputs.at("v"))) values.push_back(lut::sample(table, channel, u, v));
    return values;
  }
  return internal_error("unknown table");
}

Result<lut::TableSet> baked(const Json& inputs) {
  CUTICLE_ASSIGN(const Recipe recipe, recipe_from(inputs));
  return lut::bake(*recipe.model, recipe.values, *recipe.layout, recipe.size, silent_progress());
}

}  // namespace

/// As the file stores it: to EXR, rounded to half.
Result<Values> run_lut_stored(const Json& inputs, GpuSession*) {
  CUTICLE_ASSIGN(lut::TableSet set, baked(inputs));
  CUTICLE_ASSIGN(const lut::Format* format, lut::find_format(inputs.value("format", std::string("exr"))));
  CUTICLE_TRY(lut::store_as(set, *format));
  return sampled(set, inputs);
}

Result<Values> run_lut_f64(const Json& inputs, GpuSession*) {
  CUTICLE_ASSIGN(const lut::TableSet set, baked(inputs));
  return sampled(set, inputs);
}

#ifdef CUTICLE_HAS_GPU
Result<Values> run_lut_gpu(const Json& inputs, GpuSession* session) {
  CUTICLE_ASSIGN(const Recipe recipe, recipe_from(inputs));
  const std::string key = Json{
      {"model", inputs.at("model")},
      {"set", inputs.value("set", std::string())},
      {"layout", inputs.at("layout")},
      {"size", recipe.size}}.dump();
  auto found = session->tables.find(key);
  if (found == session->tables.end()) {
    CUTICLE_ASSIGN(lut::TableSet set,
                   lut::bake_gpu(*session->device, *recipe.model, recipe.values, *recipe.layout, recipe.size));
    found = session->tables.emplace(key, std::move(set)).first;
  }
  return sampled(found->second, inputs);
}
#endif

}  // namespace cuticle::hard_cases
