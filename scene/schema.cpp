// The JSON Schema (draft 7) of the scene file, written from its specification.

#include "core/json/json.h"
#include "scene/include.h"
#include "scene/specification.h"

namespace cuticle::scene {

namespace {

Json schema_of(const Spec& spec);

Json closed_object(Json properties) {
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
}

/// Included keys may be those that are required.
Json include_schema() {
  return {
      {"description", "files whose keys the object takes where it has none of its own"},
      {"oneOf", Json::list({Json{{"type", "string"}}, Json{{"type", "array"}, {"items", Json{{"type", "string"}}}}})}};
}

Json object_schema(const Spec& spec) {
  Json properties = Json::object(), required = Json::list();
  for (const Spec& child : spec.children) {
    properties[child.key] = schema_of(child);
    if (child.required) required.push_back(child.key);
  }
  properties[std::string(k_include)] = include_schema();
  Json schema = closed_object(std::move(properties));
  if (!required.empty())
    schema["anyOf"] = Json::list(
        {Json{{"required", std::move(required)}}, Json{{"required", Json::list({Json(std::string(k_include))})}}});
  return schema;
}

Json blocks_schema(const Spec& spec) {
  Json properties = Json::object();
  for (const registry::Entry* entry : spec.entries)
    properties[std::string(entry->name)] = Json::parse(registry::json_schema(entry->parameters)).value();
  properties[std::string(k_include)] = include_schema();
  Json schema = closed_object(std::move(properties));
  if (spec.kind == SpecKind::block) {
    schema["minProperties"] = 1;
    schema["maxProperties"] = 2;  // with what is included
  }
  return schema;
}

Json number_schema(const Spec& spec) {
  return {{"type", spec.kind == SpecKind::integer ? "integer" : "number"},
          {"minimum", spec.minimum},
          {"maximum", spec.maximum}};
}

Json array_schema(Json items, double least, double most) {
  return {{"type", "array"},
          {"items", std::move(items)},
          {"minItems", std::size_t(least)},
          {"maxItems", std::size_t(most)}};
}

Json text_schema(const Spec& spec) {
  Json schema = {{"type", "string"}};
  if (!spec.choices.empty()) schema["enum"] = spec.choices;
  return schema;
}

Json bare_schema(const Spec& spec) {
  switch (spec.kind) {
    case SpecKind::object:
      return object_schema(spec);
    case SpecKind::array:
      return array_schema(schema_of(spec.children[0]), 0, spec.maximum);
    case SpecKind::block:
    case SpecKind::blocks:
      return blocks_schema(spec);
    case SpecKind::parameters:
      return Json::parse(registry::json_schema(spec.table)).value();
    case SpecKind::text:
    case SpecKind::file:
      return text_schema(spec);
    case SpecKind::real:
    case SpecKind::integer:
      return number_schema(spec);
    case SpecKind::numbers:
      return array_schema(number_schema(spec), spec.count, spec.count);
    case SpecKind::rgb:
      return {{"oneOf", Json::list({number_schema(spec), array_schema(number_schema(spec), spec.count, spec.count)})}};
    case SpecKind::boolean:
      break;
  }
  return {{"type", "boolean"}};
}

Json schema_of(const Spec& spec) {
  Json schema = bare_schema(spec);
  if (!spec.summary.empty()) schema["description"] = spec.summary;
  return schema;
}

}  // namespace

std::string scene_schema(const Catalogue& catalogue) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Cuticle scene"}};
  schema.update(schema_of(specification(catalogue)));
  return schema.dump(2) + "\n";
}

}  // namespace cuticle::scene
