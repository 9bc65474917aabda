#pragma once
// The shading languages that snippets are written in.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace cuticle::lut::snippets {

enum class Type { boolean, integer, scalar, pair, triple, quad };
struct Parameter {
  Type type;
  std::string name;
};

/// How a language spells what a snippet needs; all else is spelled alike in the three.
struct Dialect {
  std::string_view name;       ///< "glsl"
  std::string_view extension;  ///< of a snippet's file
  std::string_view type_names[6];
  std::string_view all_within;   ///< an expression over {0} and {1}, vectors of four: every |{0}| <= {1}
  std::string_view sample;       ///< an expression over {0} = table's variable and {1} = coordinates
  std::string_view declaration;  ///< of one texture: {0} = table's variable, {1} = its binding
  std::string_view preamble;     ///< what an includer may replace: how a texture is sampled
  std::string_view sampler;      ///< of the sampler, where it is separate: {0} = its binding
  bool names_first;              ///< `let name: type` instead of `type name`
};
std::span<const Dialect> dialects();
/// Error: usage, listing them.
Result<const Dialect*> find_dialect(std::string_view name);

/// "vec3" and the like.
std::string_view type_name(const Dialect& dialect, Type type);
/// `type name(parameters) {`, a line.
std::string open_function(const Dialect& dialect, Type result, std::string_view name,
                          const std::vector<Parameter>& parameters);
/// A name for a value, two spaces in, a line.
std::string constant(const Dialect& dialect, Type type, std::string_view name, std::string_view value);
/// A vector's constructor.
std::string vector(const Dialect& dialect, Type type, const std::vector<std::string>& parts);
/// A number that all languages read as floating point.
std::string literal(double value);

}  // namespace cuticle::lut::snippets
