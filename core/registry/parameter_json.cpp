#include <cmath>

#include <fmt/core.h>

#include "core/registry/read_json.h"

namespace cuticle::registry {
namespace {

std::string copy(std::string_view text) { return std::string(text); }

Json value_json(const Value& value) {
  if (const auto* rgb = std::get_if<glm::dvec3>(&value)) return {rgb->x, rgb->y, rgb->z};
  return std::visit(
      [](const auto& held) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, glm::dvec3>)
          return nullptr;
        else
          return held;
      },
      value);
}

Json number_schema(const Parameter& parameter, const char* type) {
  return {{"type", type}, {"minimum", parameter.minimum}, {"maximum", parameter.maximum}};
}

Json rgb_schema(const Parameter& parameter) {
  const Json component = number_schema(parameter, "number");
  return {{"oneOf", {component, {{"type", "array"}, {"items", component}, {"minItems", 3}, {"maxItems", 3}}}}};
}

Json type_schema(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::integer:
      return number_schema(parameter, "integer");
    case ParameterType::boolean:
      return {{"type", "boolean"}};
    case ParameterType::choice: {
      Json names = Json::list();
      for (std::string_view choice : parameter.choices) names.push_back(copy(choice));
      return {{"type", "string"}, {"enum", names}};
    }
    case ParameterType::rgb:
      return rgb_schema(parameter);
    case ParameterType::real:
      break;
  }
  return number_schema(parameter, "number");
}

Json property_schema(const Parameter& parameter) {
  Json schema = type_schema(parameter);
  schema["description"] = fmt::format("{} [{}]", parameter.summary, parameter.unit);
  if (const Result<Value> value = parse_value(parameter, parameter.default_text))
    schema["default"] = value_json(*value);
  return schema;
}

const char* type_words(ParameterType type) {
  switch (type) {
    case ParameterType::integer:
      return "a whole number";
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::choice:
      return "a string";
    case ParameterType::rgb:
      return "a number or [r, g, b]";
    case ParameterType::real:
      break;
  }
  return "a number";
}

Error not_of_type(const Parameter& parameter, const Json& value) {
  return usage_error(fmt::format("{}: {} is not {}", parameter.name, value.dump(), type_words(parameter.type)));
}

Result<double> number_of(const Parameter& parameter, const Json& value) {
  if (!value.is_number()) return not_of_type(parameter, value);
  return within_range(parameter, value.number(), value.dump());
}

Result<Value> rgb_of(const Parameter& parameter, const Json& value) {
  if (value.is_list() && value.size() != 3) return not_of_type(parameter, value);
  glm::dvec3 rgb(0);
  for (int c = 0; c < 3; ++c) {
    CUTICLE_ASSIGN(rgb[c], number_of(parameter, value.is_list() ? value[std::size_t(c)] : value));
  }
  return Value(rgb);
}

Result<Value> value_of(const Parameter& parameter, const Json& value) {
  switch (parameter.type) {
    case ParameterType::integer:
      if (!value.is_whole()) return not_of_type(parameter, value);
      CUTICLE_TRY(number_of(parameter, value));
      return Value(value.whole());
    case ParameterType::boolean:
      if (!value.is_boolean()) return not_of_type(parameter, value);
      return Value(value.boolean());
    case ParameterType::choice:
      if (!value.is_text()) return not_of_type(parameter, value);
      return parse_value(parameter, value.text());
    case ParameterType::rgb:
      return rgb_of(parameter, value);
    case ParameterType::real:
      break;
  }
  CUTICLE_ASSIGN(const double number, number_of(parameter, value));
  return Value(number);
}

Error at_key(std::string_view where, const Error& error) {
  return bad_input(fmt::format("{}: {}", where, error.message), error.hint);
}

Result<void> assign_json(ParameterTable table, const std::string& key, const Json& value, ParameterValues& values) {
  CUTICLE_ASSIGN(const Parameter* parameter, find_parameter(table, key));
  CUTICLE_ASSIGN(Value read, value_of(*parameter, value));
  values.set(parameter->name, std::move(read));
  return {};
}

}  // namespace

std::string json_schema(ParameterTable table) {
  Json properties = Json::object();
  for (const Parameter& parameter : table) properties[copy(parameter.name)] = property_schema(parameter);
  const Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                       {"type", "object"},
                       {"properties", properties},
                       {"additionalProperties", false}};
  return schema.dump(2);
}

Result<ParameterValues> values_from_object(ParameterTable table, const Json& object, std::string_view where) {
  if (!object.is_object()) return bad_input(fmt::format("{}: not a JSON object", where), "{\"name\": value}");
  ParameterValues values = default_values(table);
  for (const auto& [key, value] : object.items())
    if (Result<void> assigned = assign_json(table, key, value, values); !assigned)
      return at_key(where, assigned.error());
  return values;
}

Result<ParameterValues> values_from_json(ParameterTable table, std::string_view text, std::string_view where) {
  const Result<Json> parsed = Json::parse(text);
  if (!parsed) return bad_input(fmt::format("{}: not valid JSON", where));
  return values_from_object(table, *parsed, where);
}

std::string to_json(const ParameterValues& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values.all()) object[name] = value_json(value);
  return object.dump();
}

}  // namespace cuticle::registry
