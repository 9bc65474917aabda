#include "lut/snippets/dialect.h"

#include <algorithm>

#include <fmt/format.h>

namespace cuticle::lut::snippets {
namespace {

constexpr Dialect k_dialects[] = {
    {"glsl",
     "glsl",
     {"bool", "int", "float", "vec2", "vec3", "vec4"},
     "all(lessThanEqual(abs({0}), {1}))",
     "CUTICLE_SAMPLE({0}, {1})",
     "uniform sampler2D {0};",
     "#ifndef CUTICLE_SAMPLE\n#define CUTICLE_SAMPLE(table, uv) textureLod(table, uv, 0.0)\n#endif\n",
     "",
     false},
    {"hlsl",
     "hlsl",
     {"bool", "int", "float", "float2", "float3", "float4"},
     "all(abs({0}) <= {1})",
     "CUTICLE_SAMPLE({0}, {1})",
     "Texture2D<float4> {0} : register(t{1});",
     "#ifndef CUTICLE_SAMPLE\n#define CUTICLE_SAMPLE(table, uv) table.SampleLevel(cuticle_sampler, uv, 0)\n#endif\n",
     "SamplerState cuticle_sampler : register(s0);",
     false},
    {"wgsl",
     "wgsl",
     {"bool", "i32", "f32", "vec2f", "vec3f", "vec4f"},
     "all(abs({0}) <= {1})",
     "textureSampleLevel({0}, cuticle_sampler, {1}, 0.0)",
     "@group(0) @binding({1}) var {0}: texture_2d<f32>;",
     "",
     "@group(0) @binding({0}) var cuticle_sampler: sampler;",
     true},
};

}  // namespace

std::span<const Dialect> dialects() { return k_dialects; }

Result<const Dialect*> find_dialect(std::string_view name) {
  for (const Dialect& dialect : k_dialects)
    if (dialect.name == name) return &dialect;
  return usage_error(fmt::format("snippet: '{}' is not one of glsl, hlsl, wgsl", name));
}

std::string_view type_name(const Dialect& dialect, Type type) { return dialect.type_names[std::size_t(type)]; }

std::string open_function(const Dialect& dialect, Type result, std::string_view name,
                          const std::vector<Parameter>& parameters) {
  std::string list;
  for (const Parameter& each : parameters) {
    const std::string_view type = type_name(dialect, each.type), comma = list.empty() ? "" : ", ";
    list += dialect.names_first ? fmt::format("{}{}: {}", comma, each.name, type)
                                : fmt::format("{}{} {}", comma, type, each.name);
  }
  if (dialect.names_first) return fmt::format("fn {}({}) -> {} {{\n", name, list, type_name(dialect, result));
  return fmt::format("{} {}({}) {{\n", type_name(dialect, result), name, list);
}

std::string constant(const Dialect& dialect, Type type, std::string_view name, std::string_view value) {
  if (dialect.names_first) return fmt::format("  let {} = {};\n", name, value);
  return fmt::format("  {} {} = {};\n", type_name(dialect, type), name, value);
}

std::string vector(const Dialect& dialect, Type type, const std::vector<std::string>& parts) {
  return fmt::format("{}({})", type_name(dialect, type), fmt::join(parts, ", "));
}

std::string literal(double value) {
  std::string text = fmt::format("{:.9g}", value);
  if (text.find_first_of(".e") == text.npos) text += ".0";
  return text;
}

}  // namespace cuticle::lut::snippets
