#include "strands/growing/specification.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/json.h"
#include "core/json/position.h"
#include "core/registry/read_json.h"

namespace cuticle::strands {

namespace {

constexpr std::string_view k_surfaces[] = {"scalp", "head"};
constexpr std::string_view k_curves[] = {"bezier", "catmull_rom", "b_spline"};
constexpr std::string_view k_interpolations[] = {"three_hairs", "nearest_hair"};

constexpr std::string_view k_keys[] = {"schema_version", "name",    "growing", "strands",
                                       "regions",        "strokes", "bun",     "shaping"};
constexpr std::size_t k_max_items = 256;  // of regions and of strokes

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

template <class Parameters>
Result<Parameters> read(const Json& value, const std::string& where) {
  CUTICLE_ASSIGN(const auto values, registry::values_from_object(registry::table_of<Parameters>(), value, where));
  return registry::from_values<Parameters>(values);
}

/// What stands under a key; the defaults where it is absent.
template <class Parameters>
Result<Parameters> read_at(const Json& root, const char* key, const std::string& where) {
  if (!root.contains(key)) return Parameters{};
  return read<Parameters>(root[key], where + ": " + key);
}

/// A list of parameter objects.
template <class Item>
Result<void> read_list(const Json& root, const char* key, const std::string& where, std::vector<Item>& out) {
  if (!root.contains(key)) return {};
  const Json& list = root[key];
  if (!list.is_list() || list.size() > k_max_items)
    return bad_input(fmt::format("{}: {} is not a list of at most {} objects", where, key, k_max_items));
  for (std::size_t i = 0; i < list.size(); ++i) {
    CUTICLE_ASSIGN(out.emplace_back(), read<Item>(list[i], fmt::format("{}: {}[{}]", where, key, i)));
  }
  return {};
}

Result<void> read_shaping(const Json& root, const std::string& where, ShapingBlocks& blocks) {
  if (!root.contains("shaping")) return {};
  if (!root["shaping"].is_object()) return bad_input(fmt::format("{}: shaping is not an object of effects", where));
  for (const auto& [name, value] : root["shaping"].items()) {
    const auto shaping = find_shaping(name);
    if (!shaping) return bad_input(fmt::format("{}: {}", where, shaping.error().message), shaping.error().hint);
    CUTICLE_ASSIGN(blocks[name],
                   registry::values_from_object((*shaping)->entry.parameters, value, where + ": shaping." + name));
  }
  return {};
}

Result<void> read_grooming(const Json& root, const std::string& where, Grooming& grooming) {
  CUTICLE_TRY(read_list(root, "regions", where, grooming.regions));
  CUTICLE_TRY(read_list(root, "strokes", where, grooming.strokes));
  if (root.contains("bun")) {
    CUTICLE_ASSIGN(grooming.bun, read_at<Bun>(root, "bun", where));
  }
  return {};
}

Json table_schema(registry::ParameterTable table) {
  Json schema = Json::parse(registry::json_schema(table)).value();
  schema.erase("$schema");
  return schema;
}

Json list_schema(registry::ParameterTable table) {
  return {{"type", "array"}, {"maxItems", k_max_items}, {"items", table_schema(table)}};
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

void describe(registry::Members& members, StrandParameters& strands) {
  members(strands.surface, "surface", k_surfaces, "What carries hair: the scalp or the whole head");
  members(strands.control_hairs, "control_hairs", 8, 100000,
          "Control hairs on the scalp, about; the head has one per vertex");
  members(strands.density, "density", "1/m2", 0, 1e8, "Drawn strands per area");
  members(strands.share, "share", "1", 0, 1, "Level of detail: share of the strands that is drawn");
  members(strands.hairline, "hairline", "1", 0, 1,
          "Share of the scalp's radius over which the density falls to nothing at its edge");
  members(strands.vertices, "vertices", 2, k_max_vertices, "Vertices of a drawn strand");
  members(strands.roots, "roots", k_root_rules, "How the place of a root is found");
  members(strands.curve, "curve", k_curves, "Curve through the control vertices");
  members(strands.nearest_hair, "interpolation", k_interpolations,
          "Strands mixed from three control hairs, or following the nearest");
  members(strands.seed, "seed", 0, 4294967295.0, "Seed of roots and shaping");
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
  CUTICLE_ASSIGN(result.growing, read_at<Style>(root, "growing", where));
  CUTICLE_ASSIGN(result.strands, read_at<StrandParameters>(root, "strands", where));
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
                           {"growing", table_schema(registry::table_of<Style>())},
                           {"strands", table_schema(registry::table_of<StrandParameters>())},
                           {"regions", list_schema(registry::table_of<Region>())},
                           {"strokes", list_schema(registry::table_of<Stroke>())},
                           {"bun", table_schema(registry::table_of<Bun>())},
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
