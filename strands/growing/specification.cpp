#include "strands/growing/specification.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/json.h"
#include "core/json/position.h"
#include "core/registry/read_json.h"
#include "strands/spline/smooth.h"

namespace cuticle::strands {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr std::string_view k_surfaces[] = {"scalp", "head"};
constexpr std::string_view k_curves[] = {"bezier", "catmull_rom", "b_spline"};
constexpr std::string_view k_interpolations[] = {"three_hairs", "nearest_hair"};
constexpr Parameter k_strands[] = {
    {"surface", ParameterType::choice, "1", 0, 0, "scalp", k_surfaces,
     "What carries hair: the scalp or the whole head"},
    {"control_hairs",
     ParameterType::integer,
     "1",
     8,
     100000,
     "300",
     {},
     "Control hairs on the scalp, about; the head has one per vertex"},
    {"density", ParameterType::real, "1/m2", 0, 1e8, "1e5", {}, "Drawn strands per area"},
    {"share", ParameterType::real, "1", 0, 1, "1", {}, "Level of detail: share of the strands that is drawn"},
    {"hairline",
     ParameterType::real,
     "1",
     0,
     1,
     "0",
     {},
     "Share of the scalp's radius over which the density falls to nothing at its edge"},
    {"vertices", ParameterType::integer, "1", 2, k_most_vertices, "30", {}, "Vertices of a drawn strand"},
    {"roots", ParameterType::choice, "1", 0, 0, "folded", k_root_rules, "How the place of a root is found"},
    {"curve", ParameterType::choice, "1", 0, 0, "bezier", k_curves, "Curve through the control vertices"},
    {"interpolation", ParameterType::choice, "1", 0, 0, "three_hairs", k_interpolations,
     "Strands mixed from three control hairs, or following the nearest"},
    {"seed", ParameterType::integer, "1", 0, 4294967295.0, "1", {}, "Seed of roots and shaping"}};

constexpr std::string_view k_keys[] = {"schema_version", "name",    "growing", "strands",
                                       "regions",        "strokes", "bun",     "shaping"};
constexpr std::size_t k_most_items = 256;  // of regions and of strokes

Result<void> check_keys(const Json& object, const std::string& where) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(std::begin(k_keys), std::end(k_keys), key) != std::end(k_keys)) continue;
    const std::string near = registry::nearest_name(key, k_keys);
    return bad_input(
        fmt::format(
            "{}: unknown key '{}'; allowed: schema_version, name, growing, strands, regions, strokes, bun, shaping",
            where, key),
        near.empty() ? "" : fmt::format("did you mean {}?", near));
  }
  if (object.contains("schema_version") && object["schema_version"] == 1) return {};
  return bad_input(
      fmt::format("{}: schema_version is {}; allowed: 1", where, object.value("schema_version", Json()).dump()),
      "\"schema_version\": 1");
}

Result<registry::ParameterValues> values_of(registry::ParameterTable table, const Json& value,
                                            const std::string& where) {
  return registry::values_from_object(table, value, where);
}

/// The table's values under a key; its defaults where the key is absent.
Result<registry::ParameterValues> values_at(registry::ParameterTable table, const Json& root, const char* key,
                                            const std::string& where) {
  if (!root.contains(key)) return registry::default_values(table);
  return values_of(table, root[key], where + ": " + key);
}

/// A list of parameter objects, each made into an Item.
template <class Item>
Result<void> read_list(const Json& root, const char* key, registry::ParameterTable table,
                       Item (*make)(const registry::ParameterValues&), const std::string& where,
                       std::vector<Item>& out) {
  if (!root.contains(key)) return {};
  const Json& list = root[key];
  if (!list.is_list() || list.size() > k_most_items)
    return bad_input(fmt::format("{}: {} is not a list of at most {} objects", where, key, k_most_items));
  for (std::size_t i = 0; i < list.size(); ++i) {
    CUTICLE_ASSIGN(const registry::ParameterValues values,
                   values_of(table, list[i], fmt::format("{}: {}[{}]", where, key, i)));
    out.push_back(make(values));
  }
  return {};
}

Result<void> read_shaping(const Json& root, const std::string& where, ShapingBlocks& blocks) {
  if (!root.contains("shaping")) return {};
  if (!root["shaping"].is_object()) return bad_input(fmt::format("{}: shaping is not an object of effects", where));
  for (const auto& [name, value] : root["shaping"].items()) {
    const auto shaping = find_shaping(name);
    if (!shaping) return bad_input(fmt::format("{}: {}", where, shaping.error().message), shaping.error().hint);
    CUTICLE_ASSIGN(blocks[name], values_of((*shaping)->entry.parameters, value, where + ": shaping." + name));
  }
  return {};
}

Result<void> read_grooming(const Json& root, const std::string& where, Grooming& grooming) {
  CUTICLE_TRY(read_list(root, "regions", region_parameters(), region_of, where, grooming.regions));
  CUTICLE_TRY(read_list(root, "strokes", stroke_parameters(), stroke_of, where, grooming.strokes));
  if (!root.contains("bun")) return {};
  CUTICLE_ASSIGN(const registry::ParameterValues values, values_of(bun_parameters(), root["bun"], where + ": bun"));
  grooming.bun = bun_of(values);
  return {};
}

Json table_schema(registry::ParameterTable table) {
  Json schema = Json::parse(registry::json_schema(table)).value();
  schema.erase("$schema");
  return schema;
}

Json list_schema(registry::ParameterTable table) {
  return {{"type", "array"}, {"maxItems", k_most_items}, {"items", table_schema(table)}};
}

Json shaping_schema() {
  Json properties = Json::object();
  for (const Shaping* shaping : shapings()) {
    Json& effect = properties[std::string(shaping->entry.name)] = table_schema(shaping->entry.parameters);
    effect["description"] = std::string(shaping->entry.summary);
  }
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
}

}  // namespace

registry::ParameterTable strand_parameters() { return k_strands; }

GroomingSpecification default_specification() {
  return {{}, registry::default_values(growing_parameters()), registry::default_values(strand_parameters()), {}, {}};
}

Result<GroomingSpecification> parse_specification(std::string_view text, const std::string& where) {
  const Result<Json> parsed = Json::parse(without_comments(text));
  if (!parsed) return bad_input(fmt::format("{}: {}", where, parsed.error().message), parsed.error().hint);
  const Json& root = *parsed;
  if (!root.is_object()) return bad_input(fmt::format("{}: not a JSON object", where), "{\"schema_version\": 1}");
  CUTICLE_TRY(check_keys(root, where));
  GroomingSpecification result;
  if (root.contains("name")) {
    if (!root["name"].is_text()) return bad_input(fmt::format("{}: name is not a text", where));
    result.name = root["name"].text();
  }
  CUTICLE_ASSIGN(result.growing, values_at(growing_parameters(), root, "growing", where));
  CUTICLE_ASSIGN(result.strands, values_at(strand_parameters(), root, "strands", where));
  CUTICLE_TRY(read_grooming(root, where, result.grooming));
  CUTICLE_TRY(read_shaping(root, where, result.shaping));
  return result;
}

Result<GroomingSpecification> load_specification(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  return parse_specification(text, path);
}

std::string specification_schema() {
  const Json properties = {{"schema_version", {{"type", "integer"}, {"minimum", 1}, {"maximum", 1}}},
                           {"name", {{"type", "string"}}},
                           {"growing", table_schema(growing_parameters())},
                           {"strands", table_schema(strand_parameters())},
                           {"regions", list_schema(region_parameters())},
                           {"strokes", list_schema(stroke_parameters())},
                           {"bun", table_schema(bun_parameters())},
                           {"shaping", shaping_schema()}};
  const Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                       {"title", "Cuticle grooming specification"},
                       {"type", "object"},
                       {"additionalProperties", false},
                       {"required", {"schema_version"}},
                       {"properties", properties}};
  return schema.dump(2) + "\n";
}

}  // namespace cuticle::strands
