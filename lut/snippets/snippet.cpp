#include "lut/snippets/snippet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cuticle::lut::snippets {
namespace {

constexpr const char* k_no_bound = "3.0e38";

std::string variable(const ManifestTable& table) { return fmt::format("cuticle_{}", table.name); }

/// A channel's place: "m.x" of the value read from its table.
std::string place(const ManifestTable& table, std::size_t channel) {
  return fmt::format("read_{}.{}", table.name, "xyzw"[channel]);
}

/// What is derived from the two directions and the tangent, in the order in which one needs another.
struct Angle {
  std::string_view name, value;
  bool rare = false;  ///< an arc function, written only where an axis needs it
};
constexpr std::string_view k_caustic_axis = "from_caustic";
constexpr Angle k_angles[] = {
    {"sin_theta_i", "clamp(dot(light, tangent), -1.0, 1.0)"},
    {"sin_theta_o", "clamp(dot(eye, tangent), -1.0, 1.0)"},
    {"cos_theta_i", "sqrt(1.0 - sin_theta_i * sin_theta_i)"},
    {"cos_theta_o", "sqrt(1.0 - sin_theta_o * sin_theta_o)"},
    {"cos_phi",
     "clamp((dot(light, eye) - sin_theta_i * sin_theta_o) / max(cos_theta_i * cos_theta_o, 1.0e-6), -1.0, 1.0)"},
    {"theta_i", "asin(sin_theta_i)", true},
    {"theta_o", "asin(sin_theta_o)", true},
    {"phi", "acos(cos_phi)", true},
    {"theta_d", "0.5 * abs(theta_o - theta_i)", true},
    {"abs_theta_o", "abs(theta_o)", true},
    {"theta_between", "0.5 * acos(clamp(dot(light, eye), -1.0, 1.0))", true},
    {"cos_normal", "cos_theta_i * cos_phi", true},
    {"half_along", "sin_theta_i + sin_theta_o", true},
    {"half_toward", "cos_theta_i * cos_phi + cos_theta_o", true},
    {"half_wide", "sqrt(half_toward * half_toward + cos_theta_i * cos_theta_i * (1.0 - cos_phi * cos_phi))", true},
    {"half_length", "max(sqrt(half_along * half_along + half_wide * half_wide), 1.0e-6)", true},
    {"theta_half", "asin(clamp(half_along / half_length, -1.0, 1.0))", true},
    {"phi_half", "acos(clamp(half_toward / max(half_wide, 1.0e-6), -1.0, 1.0))", true},
};

bool is_angle(std::string_view name) {
  return std::any_of(std::begin(k_angles), std::end(k_angles), [&](const Angle& angle) { return angle.name == name; });
}

/// theta_d is made of both inclinations, abs_theta_o of one, the half vector's angles of its parts.
bool makes(std::string_view angle, std::string_view quantity) {
  if (quantity == "theta_half" || quantity == "phi_half") return angle.starts_with("half_");
  if (quantity == "theta_d") return angle == "theta_i" || angle == "theta_o";
  return (quantity == "abs_theta_o" && angle == "theta_o") || (quantity == k_caustic_axis && angle == "phi");
}

bool is_needed(const Manifest& manifest, const Angle& angle) {
  const auto matches = [&](const ManifestAxis& axis) {
    return axis.quantity == angle.name || makes(angle.name, axis.quantity);
  };
  return !angle.rare || std::any_of(manifest.tables.begin(), manifest.tables.end(),
                                    [&](const ManifestTable& table) { return matches(table.u) || matches(table.v); });
}

std::string angles_text(const Manifest& manifest, const Dialect& dialect) {
  std::string text;
  for (const Angle& angle : k_angles)
    if (is_needed(manifest, angle)) text += constant(dialect, Type::scalar, angle.name, angle.value);
  return text;
}

/// The place of phi on an axis from the caustic, and the factor that its table leaves out (lut/caustic.glslh).
std::string caustic_text(const ManifestAxis& axis, const Dialect& dialect) {
  const auto line = [&](std::string_view name, const std::string& value) {
    return constant(dialect, Type::scalar, name, value);
  };
  const double glass = axis.eta * axis.eta - 1;
  return line("cos2_theta_d", "0.5 * (1.0 + cos_theta_i * cos_theta_o + sin_theta_i * sin_theta_o)") +
         line("caustic_excess", fmt::format("3.0 * cos2_theta_d - {}", literal(glass))) +
         line("caustic_rise", "max(caustic_excess, 0.0)") +
         line("caustic_phi", fmt::format("2.0 * atan(caustic_rise * sqrt(caustic_rise) / ({} + {} * cos2_theta_d))",
                                         literal(glass * std::sqrt(glass)), literal(9 * std::sqrt(glass)))) +
         line("beside", "phi - caustic_phi") + line("outside", "step(0.0, beside)") +
         line("caustic_root", "sqrt(abs(beside) / (outside * 3.14159265 + (1.0 - 2.0 * outside) * caustic_phi))") +
         line("from_caustic", fmt::format("(2.0 * outside - 1.0) * ({} + {} * caustic_root)", literal(axis.gap),
                                          literal(1 - axis.gap))) +
         line("caustic_peak",
              "1.0 / max((1.0 - outside) * caustic_excess * caustic_root + outside * (abs(caustic_excess) + 4.0 * "
              "beside), 1.0e-5)");
}

std::string caustic_text(const Manifest& manifest, const Dialect& dialect) {
  for (const ManifestTable& table : manifest.tables)
    if (table.u.quantity == k_caustic_axis) return caustic_text(table.u, dialect);
  return {};
}

std::string coordinate(const ManifestAxis& axis, const std::string& value) {
  if (axis.quantity == "none") return literal(axis.bias);
  return fmt::format("{} * {} + {}", value, literal(axis.scale), literal(axis.bias));
}

/// cos theta_d from the table that holds it, else from the directions.
std::string cosine_of_difference(const Manifest& manifest) {
  for (const ManifestTable& table : manifest.tables)
    for (std::size_t c = 0; c < table.channels.size(); ++c)
      if (table.channels[c].name == "cos_theta_d") return place(table, c);
  return "sqrt(max(0.5 * (1.0 + cos_theta_i * cos_theta_o + sin_theta_i * sin_theta_o), 0.0))";
}

Result<std::string> axis_value(const ManifestAxis& axis) {
  if (axis.quantity == "none" || axis.quantity == "cos_theta_d" || axis.quantity == k_caustic_axis ||
      is_angle(axis.quantity))
    return axis.quantity;
  return internal_error(fmt::format("snippet: no expression is known for the axis '{}'", axis.quantity));
}

bool needs_difference(const ManifestTable& table) {
  return table.u.quantity == "cos_theta_d" || table.v.quantity == "cos_theta_d";
}

Result<std::string> reading(const ManifestTable& table, const Dialect& dialect) {
  CUTICLE_ASSIGN(const std::string u, axis_value(table.u));
  CUTICLE_ASSIGN(const std::string v, axis_value(table.v));
  const std::string at = vector(dialect, Type::pair, {coordinate(table.u, u), coordinate(table.v, v)});
  return constant(dialect, Type::quad, fmt::format("read_{}", table.name),
                  fmt::format("cuticle_read_{}({}){}", table.name, at,
                              table.u.quantity == k_caustic_axis ? " * caustic_peak" : ""));
}

/// The tables that no cos theta_d addresses come first: one of them may hold it.
Result<std::string> readings(const Manifest& manifest, const Dialect& dialect) {
  std::string text;
  for (const bool second : {false, true}) {
    if (second) text += constant(dialect, Type::scalar, "cos_theta_d", cosine_of_difference(manifest));
    for (const ManifestTable& table : manifest.tables) {
      if (needs_difference(table) != second) continue;
      CUTICLE_ASSIGN(const std::string line, reading(table, dialect));
      text += line;
    }
  }
  return text;
}

/// What reads one channel, or three as a vector. Scalars stay scalars.
Result<std::string> factor_text(const Manifest& manifest, const std::string& factor, const Dialect& dialect) {
  std::vector<std::string> parts;
  for (const char* suffix : {"", ".r", ".g", ".b"})
    for (const ManifestTable& table : manifest.tables)
      for (std::size_t c = 0; c < table.channels.size(); ++c)
        if (table.channels[c].name == factor + suffix) parts.push_back(place(table, c));
  if (parts.size() == 1) return parts[0];
  if (parts.size() == 3) return vector(dialect, Type::triple, parts);
  return internal_error(fmt::format("snippet: '{}' names {} channels, not 1 or 3", factor, parts.size()));
}

Result<std::string> sum_of_terms(const Manifest& manifest, const Dialect& dialect) {
  std::string text = constant(dialect, Type::triple, "white", vector(dialect, Type::triple, {"1.0", "1.0", "1.0"}));
  std::string sum;
  for (std::size_t i = 0; i < manifest.terms.size(); ++i) {
    std::string product = "white";
    for (const std::string& factor : manifest.terms[i]) {
      CUTICLE_ASSIGN(const std::string read, factor_text(manifest, factor, dialect));
      product += fmt::format(" * {}", read);
    }
    text += constant(dialect, Type::triple, fmt::format("term_{}", i + 1), product);
    sum += fmt::format("{}term_{}", i == 0 ? "" : " + ", i + 1);
  }
  return fmt::format("{}  return ({}){};\n", text, sum,
                     manifest.over_cos2_theta_d ? " / max(cos_theta_d * cos_theta_d, 1.0e-6)" : "");
}

Result<std::string> scattering_function(const Manifest& manifest, const Dialect& dialect) {
  CUTICLE_ASSIGN(const std::string reads, readings(manifest, dialect));
  CUTICLE_ASSIGN(const std::string sum, sum_of_terms(manifest, dialect));
  const std::vector<Parameter> directions = {{Type::triple, "light"}, {Type::triple, "eye"}, {Type::triple, "tangent"}};
  return fmt::format(
      "\n// {}; without the cosine of theta_i. Unit vectors: to the light, to the eye, from root to tip.\n{}{}{}{}}}\n",
      manifest.composition, open_function(dialect, Type::triple, "cuticle_hair_scattering", directions),
      angles_text(manifest, dialect) + caustic_text(manifest, dialect), reads, sum);
}

std::vector<std::string> four(std::vector<std::string> parts, const char* filler) {
  parts.resize(4, filler);
  return parts;
}

std::string read_function(const ManifestTable& table, const Dialect& dialect) {
  std::vector<std::string> scales;
  std::string names;
  for (const ManifestChannel& channel : table.channels) {
    scales.push_back(literal(channel.scale));
    names += fmt::format("{}{}", names.empty() ? "" : ", ", channel.name);
  }
  const std::string sampled = fmt::format(fmt::runtime(dialect.sample), variable(table), "uv");
  return fmt::format(
      "\n// {}\n{}  return {} * {};\n}}\n", names,
      open_function(dialect, Type::quad, fmt::format("cuticle_read_{}", table.name), {{Type::pair, "uv"}}), sampled,
      vector(dialect, Type::quad, four(scales, "1.0")));
}

std::string probe_line(const ManifestTable& table, const Probe& probe, const Dialect& dialect, int code) {
  std::vector<std::string> values, tolerances;
  for (std::size_t c = 0; c < table.channels.size(); ++c) {
    values.push_back(literal(probe.values[c]));
    tolerances.push_back(literal(table.channels[c].tolerance));
  }
  const std::string at = vector(dialect, Type::pair, {literal(probe.u), literal(probe.v)});
  return fmt::format("  if (!cuticle_is_near(cuticle_read_{}({}), {}, {})) {{ return {}; }}\n", table.name, at,
                     vector(dialect, Type::quad, four(values, "0.0")),
                     vector(dialect, Type::quad, four(tolerances, k_no_bound)), code);
}

std::string probe_functions(const Manifest& manifest, const Dialect& dialect) {
  std::string text = "\n";
  text += open_function(dialect, Type::boolean, "cuticle_is_near",
                        {{Type::quad, "found"}, {Type::quad, "wanted"}, {Type::quad, "tolerance"}});
  text +=
      fmt::format("  return {};\n}}\n", fmt::format(fmt::runtime(dialect.all_within), "found - wanted", "tolerance"));
  text += "\n// 0: every probe of the manifest reads right; else 100 * table + probe, both from 1.\n";
  text += open_function(dialect, Type::integer, "cuticle_verify_probes", {});
  for (std::size_t t = 0; t < manifest.tables.size(); ++t)
    for (std::size_t p = 0; p < manifest.tables[t].probes.size(); ++p)
      text += probe_line(manifest.tables[t], manifest.tables[t].probes[p], dialect, int(100 * (t + 1) + p + 1));
  return text + "  return 0;\n}\n";
}

std::string head(const Manifest& manifest, const Dialect& dialect) {
  std::string text = fmt::format(
      "// Written by cuticle {} from manifest.json: layout {} of model {}, files in {}.\n"
      "// Textures: linear data, no sRGB decode, no mip maps, no compression; sampler: bilinear, clamped both ways.\n"
      "// Declare before including:\n",
      manifest.tool_version, manifest.layout, manifest.model, manifest.format);
  const std::string lines = declarations(manifest, dialect);
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin);
    text += fmt::format("//   {}\n", lines.substr(begin, end - begin));
    begin = end + 1;
  }
  return text.append(dialect.preamble);
}

}  // namespace

std::string declarations(const Manifest& manifest, const Dialect& dialect) {
  std::string text;
  for (std::size_t t = 0; t < manifest.tables.size(); ++t)
    text += fmt::format(fmt::runtime(dialect.declaration), variable(manifest.tables[t]), t) + "\n";
  if (!dialect.sampler.empty()) text += fmt::format(fmt::runtime(dialect.sampler), manifest.tables.size()) + "\n";
  return text;
}

Result<std::string> snippet(const Manifest& manifest, const Dialect& dialect) {
  std::string text = head(manifest, dialect);
  for (const ManifestTable& table : manifest.tables) text += read_function(table, dialect);
  if (!manifest.terms.empty()) {
    CUTICLE_ASSIGN(const std::string scattering, scattering_function(manifest, dialect));
    text += scattering;
  }
  return text + probe_functions(manifest, dialect);
}

}  // namespace cuticle::lut::snippets
