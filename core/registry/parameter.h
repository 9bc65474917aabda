#pragma once
// Parameter tables: the one description from which --set, the scene's JSON schema, Python names and docs are made.
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"

namespace cuticle::registry {

enum class ParameterType { real, integer, boolean, choice, rgb };

/// A value of any parameter. real -> double, integer -> int64, boolean -> bool, choice -> string, rgb -> dvec3.
using Value = std::variant<double, std::int64_t, bool, std::string, glm::dvec3>;

/// One parameter: name (the field's own term), unit ("1", "rad", "m", ...), inclusive range and default.
struct Parameter {
  std::string_view name;
  ParameterType type = ParameterType::real;
  std::string_view unit = "1";
  double minimum = 0, maximum = 0;            ///< range of a number, and of each component of an rgb
  std::string_view default_text;              ///< as it would be typed after `--set name=`
  std::span<const std::string_view> choices = {};
  std::string_view summary;
};
using ParameterTable = std::span<const Parameter>;

/// Validated values, one for every parameter of the table they were made from (defaults filled in).
class ParameterValues {
 public:
  double real(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  bool boolean(std::string_view name) const;
  const std::string& choice(std::string_view name) const;
  glm::dvec3 rgb(std::string_view name) const;
  void set(std::string_view name, Value value) { values_[std::string(name)] = std::move(value); }
  const std::map<std::string, Value, std::less<>>& all() const { return values_; }
  bool operator==(const ParameterValues&) const = default;

 private:
  std::map<std::string, Value, std::less<>> values_;
};

/// A row of the table by name. Error: usage, listing the known names and hinting at the nearest.
Result<const Parameter*> find_parameter(ParameterTable table, std::string_view name);

/// The defaults of a table.
ParameterValues default_values(ParameterTable table);

/// Parses one value as typed ("0.2", "true", "sine", "0.2/0.4/0.8" or one number for an rgb) and checks its range.
/// Error: usage, naming parameter, value and allowed range.
Result<Value> parse_value(const Parameter& parameter, std::string_view text);

/// "name=value,name=value" over the defaults. Unknown names are refused with the nearest known one. A real parameter in
/// radians also takes degrees under its name with `_deg`: "alpha_deg=-7.5".
Result<ParameterValues> parse_assignments(ParameterTable table, std::string_view text);

/// A value as it would be typed.
std::string to_text(const Value& value);

/// The known name nearest to `name` by edits, in any case and with its unit left off (`fov` of `fov_deg`); or empty.
std::string nearest_name(std::string_view name, std::span<const std::string_view> known);

/// A JSON Schema (draft 7) object for the table, as text; unknown keys are refused by it.
std::string json_schema(ParameterTable table);

/// Values from a JSON object (as text), checked against the table; `where` prefixes error messages ("sim.classic").
Result<ParameterValues> values_from_json(ParameterTable table, std::string_view json, std::string_view where);

/// Values as a JSON object.
std::string to_json(const ParameterValues& values);

}  // namespace cuticle::registry
