// BasisCurves in USD's text (.usda), with the groom_* attributes of Unreal's groom schema
// (dev.epicgames.com, "Using Alembic for Grooms"). Widths are diameters.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include <fmt/core.h>
#include <glm/common.hpp>

#include "core/memory_limit.h"
#include "strands/finite.h"
#include "strands/formats/bytes.h"
#include "strands/formats/curve_basis.h"
#include "strands/formats/number_text.h"
#include "strands/formats/usda/detail/properties.h"
#include "strands/formats/words.h"

namespace cuticle::strands::usda {

namespace {

constexpr std::string_view k_primvar = "primvars:", k_groom = "groom_";
/// Said again by what a groom is; not attributes.
constexpr std::string_view k_implied[] = {"id", "version_major", "version_minor", "width"};

/// Reads one BasisCurves prim.
class Builder {
 public:
  Builder(const Prim& prim, const std::string& where, Damage damage) : prim_(prim), where_(where), damage_(damage) {}

  /// Primvars whose number fits neither strands nor vertices, each after a space.
  const std::string& left_out() const { return left_out_; }

  Result<Groom> build() {
    CUTICLE_TRY(read_basis());
    CUTICLE_TRY(read_curves());
    CUTICLE_TRY(read_radii());
    for (const auto& [name, property] : prim_)
      if (name.starts_with(k_primvar) || name.starts_with(k_groom)) CUTICLE_TRY(read_primvar(name, property));
    return std::move(groom_);
  }

 private:
  Error error(std::string_view name, const std::string& what) const {
    return bad_input(fmt::format("{}: {}: {}", where_, name, what));
  }

  const Property* find(std::string_view name) const {
    const auto found = prim_.find(name);
    return found == prim_.end() ? nullptr : &found->second;
  }
  std::string text(std::string_view name, const char* otherwise) const {
    const Property* property = find(name);
    return property && !property->text.empty() ? property->text : otherwise;
  }

  Result<void> read_basis() {
    if (text("wrap", "nonperiodic") == "periodic") return error("wrap", "'periodic': strands are open");
    basis_.pinned = text("wrap", "nonperiodic") == "pinned";
    if (text("type", "cubic") == "linear") return {};
    const std::string basis = text("basis", "bezier");
    if (basis == "bezier")
      basis_.kind = CurveBasis::Kind::bezier;
    else if (basis == "bspline")
      basis_.kind = CurveBasis::Kind::b_spline;
    else if (basis == "catmullRom")
      basis_.kind = CurveBasis::Kind::catmull_rom;
    else
      return error("basis", fmt::format("'{}', allowed bezier, bspline, catmullRom", basis.substr(0, 40)));
    return {};
  }

  Result<void> read_curves() {
    const Property *counts = find("curveVertexCounts"), *points = find("points");
    if (!counts || !points || counts->numbers.empty()) return error("BasisCurves", "no curveVertexCounts and points");
    double total = 0;
    for (double count : counts->numbers) {
      total += count;
      if (!(count >= 1 && total * 3 <= double(points->numbers.size())) || count != std::floor(count) ||
          !(makes_a_curve(basis_, std::size_t(count)) ||
            (damage_ == Damage::keep && basis_.kind == CurveBasis::Kind::linear)))
        return error("curveVertexCounts", fmt::format("curve {} has {} points of {}: no curve of this basis",
                                                      counts_.size(), count, points->numbers.size() / 3));
      counts_.push_back(std::size_t(count));
    }
    if (total * 3 != double(points->numbers.size()))
      return error("points", fmt::format("{} numbers, curves have {} points", points->numbers.size(), total));
    const std::vector<float> values(points->numbers.begin(), points->numbers.end());
    const auto* control = reinterpret_cast<const glm::vec3*>(values.data());
    for (std::size_t count : counts_) {
      const std::vector<glm::vec3> polyline = joints(basis_, std::span(control, count));
      groom_.positions.insert(groom_.positions.end(), polyline.begin(), polyline.end());
      groom_.offsets.push_back(std::uint32_t(groom_.positions.size()));
      control += count;
    }
    control_count_ = std::size_t(total);
    return require_finite_values("points", {&groom_.positions.front().x, 3 * groom_.vertex_count()});
  }

  Result<void> require_finite_values(std::string_view name, std::span<const float> values) const {
    const std::size_t bad = damage_ == Damage::keep ? values.size() : first_not_finite(values);
    return bad == values.size() ? Result<void>() : error(name, fmt::format("number {} is not finite", bad));
  }

  /// Values of the control points as values of the joints that are the groom's vertices.
  std::vector<float> at_joints(const std::vector<float>& values, std::size_t components) const {
    std::vector<float> result;
    std::size_t begin = 0;
    for (std::size_t count : counts_) {
      std::vector<std::vector<float>> channels;
      for (std::size_t c = 0; c < components; ++c) {
        std::vector<float> control;
        for (std::size_t i = 0; i < count; ++i) control.push_back(values[(begin + i) * components + c]);
        channels.push_back(joints(basis_, std::span<const float>(control)));
      }
      for (std::size_t i = 0; i < channels.front().size(); ++i)
        for (const std::vector<float>& channel : channels) result.push_back(channel[i]);
      begin += count;
    }
    return result;
  }

  /// One array of values: for every vertex, or for every strand. Empty where its number fits neither.
  struct Spread {
    Attribute::Domain domain;
    std::vector<float> values;
  };
  Result<Spread> spread_over(const Property& property, std::size_t components) {
    const std::vector<float> values(property.numbers.begin(), property.numbers.end());
    const std::size_t rows = components == 0 ? 0 : values.size() / components, strands = groom_.strand_count();
    if (rows == 0 || values.size() % components != 0) return Spread{};
    if (rows == strands) return Spread{Attribute::Domain::strand, values};
    if (rows == control_count_) return Spread{Attribute::Domain::vertex, at_joints(values, components)};
    if (rows == groom_.vertex_count()) return Spread{Attribute::Domain::vertex, values};
    if (rows != 1) return Spread{};
    constexpr std::uint64_t huge = std::uint64_t(1) << 56;
    memory_ += product_within(huge, {components, strands, sizeof(float)}).value_or(huge);
    CUTICLE_TRY(
        require_memory(fmt::format("{}: {} numbers for each of {} strands", where_, components, strands), {memory_}));
    std::vector<float> repeated;
    for (std::size_t s = 0; s < strands; ++s) repeated.insert(repeated.end(), values.begin(), values.end());
    return Spread{Attribute::Domain::strand, std::move(repeated)};
  }

  Result<void> read_radii() {
    groom_.radii.assign(groom_.vertex_count(), 0.0f);
    const Property* widths = find("widths");
    if (!widths) widths = find("primvars:groom_width");
    if (!widths) return {};
    CUTICLE_ASSIGN(const Spread spread, spread_over(*widths, 1));
    if (spread.values.empty())
      return error("widths", fmt::format("{} numbers for {} curves and {} points", widths->numbers.size(),
                                         counts_.size(), control_count_));
    CUTICLE_TRY(require_finite_values("widths", spread.values));
    for (std::size_t s = 0; s < groom_.strand_count(); ++s)
      for (std::size_t v = groom_.offsets[s]; v < groom_.offsets[s + 1]; ++v)
        groom_.radii[v] = 0.5f * spread.values[spread.domain == Attribute::Domain::strand ? s : v];
    for (std::size_t v = 0; damage_ == Damage::refuse && v < groom_.radii.size(); ++v)
      if (groom_.radii[v] < 0)
        return error("widths", fmt::format("{} at point {}, must be at least 0", 2 * double(groom_.radii[v]), v));
    return {};
  }

  Result<void> read_primvar(std::string_view full_name, const Property& property) {
    std::string_view name = full_name;
    if (name.starts_with(k_primvar)) name.remove_prefix(k_primvar.size());
    if (name.starts_with(k_groom)) name.remove_prefix(k_groom.size());
    if (std::find(std::begin(k_implied), std::end(k_implied), name) != std::end(k_implied) || property.numbers.empty())
      return {};
    const std::size_t components = property.components();
    CUTICLE_ASSIGN(Spread spread, spread_over(property, components));
    if (spread.values.empty() || !is_plain_word(name)) {
      left_out_ += fmt::format(" {}", full_name);
      return {};
    }
    CUTICLE_TRY(require_finite_values(full_name, spread.values));
    const bool is_strand = spread.domain == Attribute::Domain::strand;
    if (is_strand && name == "root_uv" && components >= 2)
      groom_.root_uv = pairs(spread.values, components);
    else if (is_strand && name == "root_barycentrics" && components == 2)
      groom_.root_barycentrics = pairs(spread.values, 2);
    else if (is_strand && name == "root_triangle" && components == 1)
      return read_triangles(property.numbers);
    else
      groom_.attributes[std::string(name)] = {spread.domain, int(components), std::move(spread.values)};
    return {};
  }

  static std::vector<glm::vec2> pairs(const std::vector<float>& values, std::size_t components) {
    std::vector<glm::vec2> result;
    for (std::size_t i = 0; i + 1 < values.size(); i += components) result.emplace_back(values[i], values[i + 1]);
    return result;
  }

  Result<void> read_triangles(const std::vector<double>& numbers) {
    for (std::size_t s = 0; s < groom_.strand_count(); ++s) {
      const double triangle = numbers[numbers.size() == 1 ? 0 : s];
      if (!(triangle >= 0 && triangle <= 4294967295.0))
        return error("root_triangle", fmt::format("{} of strand {}", triangle, s));
      groom_.root_triangle.push_back(std::uint32_t(triangle));
    }
    return {};
  }

  const Prim& prim_;
  const std::string& where_;
  Damage damage_;
  CurveBasis basis_;
  Groom groom_;
  std::vector<std::size_t> counts_;  ///< control points of every curve
  std::size_t control_count_ = 0;
  std::uint64_t memory_ = 1;  ///< of values that are repeated for every strand
  std::string left_out_;
};

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  CUTICLE_ASSIGN(const Stage stage, parse_stage(to_text(bytes), where));
  ParsedGroom parsed;
  parsed.metres_per_unit = stage.metres_per_unit;
  for (const Prim& prim : stage.curves) {
    Builder builder(prim, where, damage);
    CUTICLE_ASSIGN(const Groom groom, builder.build());
    if (!builder.left_out().empty()) parsed.notes.push_back("primvars left out:" + builder.left_out());
    if (&prim == &stage.curves.front())
      parsed.groom = groom;
    else
      append(parsed.groom, groom);
  }
  if (parsed.groom.strand_count() == 0) return bad_input(where + ": no BasisCurves, at least 1 is needed");
  if (stage.has_transforms) parsed.notes.push_back("the file's transformations are not applied");
  if (stage.has_samples) parsed.notes.push_back("the file's time samples are not read");
  if (stage.up_axis == "Z") parsed.notes.push_back("the file's up axis is Z: not turned");
  return parsed;
}

/// Appends `[a, b, (c, d), ..]` of values with so many components.
template <class T>
void append_list(std::string& text, std::span<const T> values, std::size_t components = 1) {
  const bool in_rows = components > 1;
  text += '[';
  append_rows(text, values, components, {in_rows ? "(" : "", ", ", in_rows ? ")" : "", ", "});
  if (!values.empty()) text.resize(text.size() - 2);  // what stands between rows
  text += ']';
}

template <class T>
void add(std::string& text, std::string_view type, std::string_view name, std::span<const T> values,
         std::size_t components, std::string_view interpolation, std::size_t element_size = 1) {
  fmt::format_to(std::back_inserter(text), "        {} {} = ", type, name);
  append_list(text, values, components);
  fmt::format_to(std::back_inserter(text), " (\n            interpolation = \"{}\"\n", interpolation);
  if (element_size > 1) fmt::format_to(std::back_inserter(text), "            elementSize = {}\n", element_size);
  text += "        )\n";
}

void add_attribute(std::string& text, const std::string& name, const Attribute& attribute) {
  const std::size_t components = std::size_t(attribute.components);
  const bool is_whole = components == 1 && (name == "group_id" || name == "guide");  // Unreal reads these as int
  const std::string type = is_whole                             ? "int[]"
                           : name == "color" && components == 3 ? "color3f[]"
                           : components >= 2 && components <= 4 ? fmt::format("float{}[]", components)
                                                                : "float[]";
  add(text, type, fmt::format("{}{}{}", k_primvar, k_groom, name), std::span<const float>(attribute.values),
      components <= 4 ? components : 1, attribute.domain == Attribute::Domain::strand ? "uniform" : "vertex",
      components <= 4 ? 1 : components);
}

void add_pairs(std::string& text, std::string_view name, std::string_view type, const std::vector<glm::vec2>& pairs) {
  if (!pairs.empty())
    add(text, type, fmt::format("{}{}{}", k_primvar, k_groom, name),
        std::span<const float>(&pairs.front().x, 2 * pairs.size()), 2, "uniform");
}

/// The box of the curves with their width, as UsdGeomBoundable asks for it; a number stays one that a float holds.
Bounds extent_of(const Groom& groom) {
  constexpr float largest = std::numeric_limits<float>::max();
  Bounds box = bounds(groom);
  const float radius = groom.radii.empty() ? 0.0f : *std::ranges::max_element(groom.radii);
  box.lower = glm::max(box.lower - radius, glm::vec3(-largest));
  box.upper = glm::min(box.upper + radius, glm::vec3(largest));
  return box;
}

std::vector<float> widths_of(const Groom& groom) {
  std::vector<float> widths;
  for (float radius : groom.radii) widths.push_back(std::min(radius, 0.5f * std::numeric_limits<float>::max()) * 2);
  return widths;
}

void append_curves(std::string& text, const Groom& groom) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s) counts.push_back(std::uint32_t(groom.strand_size(s)));
  text += "        int[] curveVertexCounts = ";
  append_list(text, std::span<const std::uint32_t>(counts));
  const auto [lower, upper] = extent_of(groom);
  fmt::format_to(std::back_inserter(text), "\n        float3[] extent = [({}, {}, {}), ({}, {}, {})]\n", lower.x,
                 lower.y, lower.z, upper.x, upper.y, upper.z);
  text += "        point3f[] points = ";
  append_list(text, std::span<const float>(&groom.positions.front().x, 3 * groom.vertex_count()), 3);
  text += '\n';
  const std::vector<float> widths = widths_of(groom);
  add(text, "float[]", "widths", std::span<const float>(widths), 1, "vertex");
}

Result<std::vector<std::byte>> format_usda(const Groom& groom, double metres_per_unit) {
  constexpr std::size_t k_bytes_of_vertex = 48;  // so that the text is seldom moved
  std::string text;
  text.reserve(groom.vertex_count() * k_bytes_of_vertex);
  fmt::format_to(
      std::back_inserter(text),
      "#usda 1.0\n(\n    defaultPrim = \"groom\"\n    metersPerUnit = {}\n    upAxis = \"Y\"\n)\n\n"
      "def Xform \"groom\" (\n    prepend apiSchemas = [\"GroomAPI\"]\n)\n{{\n    def BasisCurves \"strands\"\n    {{\n"
      "        uniform token type = \"linear\"\n        uniform token wrap = \"nonperiodic\"\n"
      "        int primvars:groom_version_major = 1\n        int primvars:groom_version_minor = 5\n",
      metres_per_unit);
  append_curves(text, groom);
  std::vector<std::uint32_t> ids(groom.strand_count());
  std::iota(ids.begin(), ids.end(), 0u);
  add(text, "int[]", "primvars:groom_id", std::span<const std::uint32_t>(ids), 1, "uniform");
  add_pairs(text, "root_uv", "float2[]", groom.root_uv);
  add_pairs(text, "root_barycentrics", "float2[]", groom.root_barycentrics);
  if (!groom.root_triangle.empty())
    add(text, "int[]", "primvars:groom_root_triangle", std::span<const std::uint32_t>(groom.root_triangle), 1,
        "uniform");
  for (const auto& [name, attribute] : groom.attributes) add_attribute(text, name, attribute);
  return to_bytes(text += "    }\n}\n");
}

constexpr std::string_view k_extensions[] = {"usda"};

}  // namespace

const Format& entry() {
  static const Format format{.name = "usda",
                             .extensions = k_extensions,
                             .summary = "USD text: BasisCurves with the groom_* attributes of Unreal",
                             .holds = {.widths = Widths::vertices, .root_uv = true, .roots = true, .attributes = true},
                             .parse = parse,
                             .format = format_usda};
  return format;
}

}  // namespace cuticle::strands::usda
