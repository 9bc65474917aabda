#include "core/registry/read_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/registry/former_names.h"
#include "core/text.h"

namespace cuticle::registry {
namespace {

template <class T>
const T& held(const std::map<std::string, Value, std::less<>>& values, std::string_view name) {
  const auto found = values.find(name);
  CUTICLE_EXPECT(found != values.end(), "a parameter is asked for by a name of its table");
  CUTICLE_EXPECT(std::holds_alternative<T>(found->second), "a parameter is asked for by its type");
  return *std::get_if<T>(&found->second);
}

Error refusal(const Parameter& parameter, std::string_view text, const std::string& wanted) {
  return usage_error(fmt::format("{}: '{}' is not {}", parameter.name, text, wanted),
                     fmt::format("{}={}", parameter.name, parameter.default_text));
}

std::string range_words(const Parameter& parameter) {
  const std::string unit = parameter.unit.empty() || parameter.unit == "1" ? "" : fmt::format(" {}", parameter.unit);
  return fmt::format("{:g} .. {:g}{}", parameter.minimum, parameter.maximum, unit);
}

constexpr std::string_view degree_suffix = "_deg";
constexpr double radians_per_degree = 0.017453292519943295;

/// An angle beyond its range in radians that lies within it in degrees was most likely typed in degrees.
Error angle_refusal(const Parameter& parameter, std::string_view text, double value) {
  Error error = refusal(parameter, text, "within " + range_words(parameter));
  const double radians = value * radians_per_degree;
  if (parameter.unit == "rad" && radians >= parameter.minimum && radians <= parameter.maximum)
    error.hint = fmt::format("{} degrees is {}{}={} or {}={:.4g}", text, parameter.name, degree_suffix, text,
                             parameter.name, radians);
  return error;
}

Result<double> parse_component(const Parameter& parameter, std::string_view text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return refusal(parameter, text, "a number");
  return within_range(parameter, value, text);
}

Result<Value> parse_integer(const Parameter& parameter, std::string_view text) {
  std::int64_t value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return refusal(parameter, text, "a whole number");
  CUTICLE_TRY(within_range(parameter, double(value), text));
  return Value(value);
}

Result<Value> parse_boolean(const Parameter& parameter, std::string_view text) {
  if (text == "true" || text == "1" || text == "on" || text == "yes") return Value(true);
  if (text == "false" || text == "0" || text == "off" || text == "no") return Value(false);
  return refusal(parameter, text, "true or false");
}

Result<Value> parse_choice(const Parameter& parameter, std::string_view text) {
  const std::string_view now = name_now(parameter.name, text);
  for (std::string_view choice : parameter.choices)
    if (now == choice) return Value(std::string(choice));
  Error error = refusal(parameter, text, fmt::format("one of {}", fmt::join(parameter.choices, ", ")));
  if (const std::string near = nearest_name(text, parameter.choices); !near.empty())
    error.hint = fmt::format("{}={}", parameter.name, near);
  return error;
}

Result<Value> parse_rgb(const Parameter& parameter, std::string_view text) {
  glm::dvec3 rgb(0);
  int count = 0;
  for (std::string_view rest = text; count < 3; ++count) {
    const std::size_t slash = rest.find('/');
    CUTICLE_ASSIGN(rgb[count], parse_component(parameter, rest.substr(0, slash)));
    if (slash == std::string_view::npos && count == 0) return Value(glm::dvec3(rgb[0]));
    const bool last = slash == std::string_view::npos;
    if (last != (count == 2)) return refusal(parameter, text, "one number or three as r/g/b");
    if (!last) rest.remove_prefix(slash + 1);
  }
  return Value(rgb);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The angle that `name` means in degrees: "alpha_deg" for a real parameter "alpha" in radians; null for any other
/// name.
const Parameter* find_angle(ParameterTable table, std::string_view name) {
  if (!name.ends_with(degree_suffix)) return nullptr;
  name.remove_suffix(degree_suffix.size());
  for (const Parameter& parameter : table)
    if (parameter.name == name && parameter.unit == "rad" && parameter.type == ParameterType::real) return &parameter;
  return nullptr;
}

Result<Value> parse_degrees(const Parameter& angle, std::string_view name, std::string_view text) {
  Parameter in_degrees = angle;
  in_degrees.name = name;
  in_degrees.unit = "deg";
  in_degrees.minimum = angle.minimum / radians_per_degree;
  in_degrees.maximum = angle.maximum / radians_per_degree;
  CUTICLE_ASSIGN(double degrees, parse_component(in_degrees, text));
  return Value(std::clamp(degrees * radians_per_degree, angle.minimum, angle.maximum));
}

Result<void> assign(ParameterTable table, std::string_view assignment, ParameterValues& values) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos)
    return usage_error(fmt::format("{} is not name=value", in_quotes(assignment)), "--set name=value,name=value");
  const std::string_view name = trimmed(assignment.substr(0, equals)), text = trimmed(assignment.substr(equals + 1));
  if (const Parameter* angle = find_angle(table, name)) {
    CUTICLE_ASSIGN(Value radians, parse_degrees(*angle, name, text));
    values.set(angle->name, std::move(radians));
    return {};
  }
  CUTICLE_ASSIGN(const Parameter* parameter, find_parameter(table, name));
  CUTICLE_ASSIGN(Value value, parse_value(*parameter, text));
  values.set(parameter->name, std::move(value));
  return {};
}

}  // namespace

Result<double> within_range(const Parameter& parameter, double value, std::string_view text) {
  if (value >= parameter.minimum && value <= parameter.maximum) return value;
  return angle_refusal(parameter, text, value);
}

double ParameterValues::real(std::string_view name) const { return held<double>(values_, name); }
std::int64_t ParameterValues::integer(std::string_view name) const { return held<std::int64_t>(values_, name); }
bool ParameterValues::boolean(std::string_view name) const { return held<bool>(values_, name); }
const std::string& ParameterValues::choice(std::string_view name) const { return held<std::string>(values_, name); }
glm::dvec3 ParameterValues::rgb(std::string_view name) const { return held<glm::dvec3>(values_, name); }

Result<const Parameter*> find_parameter(ParameterTable table, std::string_view name) {
  std::vector<std::string_view> known;
  const std::string_view now = name_now("", name);
  for (const Parameter& parameter : table) {
    if (parameter.name == now) return &parameter;
    known.push_back(parameter.name);
  }
  const std::string near = nearest_name(name, known);
  const std::string list = known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "));
  return usage_error(fmt::format("unknown parameter {} (known: {})", in_quotes(name), list),
                     near.empty() ? "" : "did you mean " + near + "?");
}

Result<Value> parse_value(const Parameter& parameter, std::string_view text) {
  switch (parameter.type) {
    case ParameterType::integer:
      return parse_integer(parameter, text);
    case ParameterType::boolean:
      return parse_boolean(parameter, text);
    case ParameterType::choice:
      return parse_choice(parameter, text);
    case ParameterType::rgb:
      return parse_rgb(parameter, text);
    case ParameterType::real:
      break;
  }
  CUTICLE_ASSIGN(double value, parse_component(parameter, text));
  return Value(value);
}

ParameterValues default_values(ParameterTable table) {
  ParameterValues values;
  for (const Parameter& parameter : table) {
    Result<Value> value = parse_value(parameter, parameter.default_text);
    CUTICLE_EXPECT(value.ok(), "a default lies within its own range");
    if (value) values.set(parameter.name, *std::move(value));
  }
  return values;
}

Result<ParameterValues> parse_assignments(ParameterTable table, std::string_view text) {
  ParameterValues values = default_values(table);
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view assignment = trimmed(text.substr(0, comma));
    if (!assignment.empty()) CUTICLE_TRY(assign(table, assignment, values));
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
  }
  return values;
}

std::string to_text(const Value& value) {
  if (const auto* rgb = std::get_if<glm::dvec3>(&value)) return fmt::format("{}/{}/{}", rgb->x, rgb->y, rgb->z);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return fmt::format("{}", *std::get_if<double>(&value));
}

}  // namespace cuticle::registry
