// Strand sets in PLY: hairutil's and our own (element `strand`), line sets, and the point clouds of reconstruction
// papers.
#include <algorithm>
#include <iterator>

#include <fmt/core.h>

#include "strands/finite.h"
#include "strands/formats/bytes.h"
#include "strands/formats/ply/detail/layouts.h"
#include "strands/formats/words.h"

namespace cuticle::strands::ply {

namespace {

constexpr double k_byte = 1.0 / 255;

/// The values of some properties of an element as one array; colours of whole numbers become 0 .. 1.
std::vector<float> values_of(std::span<const Property* const> properties, std::span<const std::uint32_t> rows) {
  std::vector<float> values;
  values.reserve(rows.size() * properties.size());
  for (std::uint32_t row : rows)
    for (const Property* property : properties) values.push_back(float(property->values[row]));
  return values;
}

/// "name_0", "name_1", ..: the properties of an attribute of several components; else the one of that name.
struct Named {
  std::string name;
  std::vector<const Property*> properties;
  bool is_numbered;
};
std::vector<Named> attributes_of(const Element& element, std::span<const std::string_view> others) {
  std::vector<Named> result;
  for (const Property& property : element.properties) {
    if (property.is_list || std::find(others.begin(), others.end(), property.name) != others.end()) continue;
    const bool goes_on = !result.empty() && result.back().is_numbered &&
                         property.name == fmt::format("{}_{}", result.back().name, result.back().properties.size());
    const bool begins = property.name.ends_with("_0");
    if (goes_on)
      result.back().properties.push_back(&property);
    else
      result.push_back({property.name.substr(0, property.name.size() - (begins ? 2 : 0)), {&property}, begins});
  }
  return result;
}

class Builder {
 public:
  Builder(const Elements& elements, const Layout& layout, const std::string& where, Damage damage)
      : elements_(elements), vertex_(*find(elements, "vertex")), layout_(layout), where_(where), damage_(damage) {}

  Result<Groom> build() {
    groom_.offsets = layout_.offsets;
    const Property* xyz[] = {vertex_.find("x"), vertex_.find("y"), vertex_.find("z")};
    CUTICLE_ASSIGN(const std::vector<float> coordinates, finite_values("position", xyz, layout_.rows));
    groom_.positions.resize(layout_.rows.size());
    std::memcpy(groom_.positions.data(), coordinates.data(), 4 * coordinates.size());
    CUTICLE_TRY(read_radii());
    CUTICLE_TRY(read_color());
    constexpr std::string_view taken[] = {"x", "y", "z", "radius", "thickness", "red", "green", "blue"};
    CUTICLE_TRY(read_attributes(vertex_, taken, layout_.rows, Attribute::Domain::vertex));
    if (const Element* strand = find(elements_, "strand")) CUTICLE_TRY(read_strand_element(*strand));
    return std::move(groom_);
  }

 private:
  Result<std::vector<float>> finite_values(const std::string& name, std::span<const Property* const> properties,
                                           std::span<const std::uint32_t> rows) const {
    std::vector<float> values = values_of(properties, rows);
    const std::size_t bad = damage_ == Damage::keep ? values.size() : first_not_finite(values);
    if (bad == values.size()) return values;
    return bad_input(
        fmt::format("{}: {} of vertex or strand {} is not finite", where_, name, rows[bad / properties.size()]));
  }

  Result<void> read_radii() {
    const Property *radius = vertex_.find("radius"), *thickness = vertex_.find("thickness");
    groom_.radii.assign(layout_.rows.size(), 0.0f);
    const Property* given[] = {radius ? radius : thickness};
    if (!given[0]) return {};
    CUTICLE_ASSIGN(groom_.radii, finite_values("radius", given, layout_.rows));
    for (std::size_t v = 0; v < groom_.radii.size(); ++v) {
      if (!radius) groom_.radii[v] *= 0.5f;
      if (groom_.radii[v] < 0 && damage_ == Damage::refuse)
        return bad_input(fmt::format("{}: radius of vertex {} is {}, must be at least 0", where_, layout_.rows[v],
                                     double(groom_.radii[v])));
    }
    return {};
  }

  Result<void> read_color() {
    const Property* rgb[] = {vertex_.find("red"), vertex_.find("green"), vertex_.find("blue")};
    if (!rgb[0] || !rgb[1] || !rgb[2]) return {};
    CUTICLE_ASSIGN(std::vector<float> values, finite_values("color", rgb, layout_.rows));
    if (rgb[0]->kind != 'f')
      for (float& value : values) value = float(double(value) * k_byte);
    groom_.attributes["color"] = {Attribute::Domain::vertex, 3, std::move(values)};
    return {};
  }

  Result<void> read_attributes(const Element& element, std::span<const std::string_view> taken,
                               std::span<const std::uint32_t> rows, Attribute::Domain domain) {
    for (const Named& named : attributes_of(element, taken)) {
      CUTICLE_ASSIGN(std::vector<float> values, finite_values(named.name, named.properties, rows));
      groom_.attributes[named.name] = {domain, int(named.properties.size()), std::move(values)};
    }
    return {};
  }

  Result<void> read_pairs(const Element& strand, const char* a, const char* b, std::vector<glm::vec2>& pairs) {
    const Property* both[] = {strand.find(a), strand.find(b)};
    if (!both[0] || !both[1]) return {};
    CUTICLE_ASSIGN(const std::vector<float> values, finite_values(a, both, strands_));
    for (std::size_t s = 0; s < strands_.size(); ++s) pairs.emplace_back(values[2 * s], values[2 * s + 1]);
    return {};
  }

  Result<void> read_strand_element(const Element& strand) {
    if (strand.rows != groom_.strand_count()) return {};
    for (std::uint32_t s = 0; s < strand.rows; ++s) strands_.push_back(s);
    CUTICLE_TRY(read_pairs(strand, "root_u", "root_v", groom_.root_uv));
    CUTICLE_TRY(read_pairs(strand, "root_b", "root_c", groom_.root_barycentrics));
    if (const Property* triangle = strand.find("root_triangle"); triangle && triangle->kind == 'u')
      for (double value : triangle->values) groom_.root_triangle.push_back(std::uint32_t(value));
    constexpr std::string_view taken[] = {"nsegs", "root_u", "root_v", "root_b", "root_c", "root_triangle"};
    return read_attributes(strand, taken, strands_, Attribute::Domain::strand);
  }

  const Elements& elements_;
  const Element& vertex_;
  const Layout& layout_;
  const std::string& where_;
  Damage damage_;
  Groom groom_;
  std::vector<std::uint32_t> strands_;  ///< 0, 1, ..: the rows of element strand
};

Result<void> require_two_points(const Layout& layout, const std::string& where) {
  for (std::size_t s = 0; s + 1 < layout.offsets.size(); ++s)
    if (layout.offsets[s + 1] - layout.offsets[s] < 2)
      return bad_input(fmt::format("{}: strand {} has 1 point, at least 2 are needed", where, s),
                       "--repair takes such strands out");
  return {};
}

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  CUTICLE_ASSIGN(const Elements elements, parse_elements(bytes, where));
  CUTICLE_ASSIGN(const Layout layout, find_layout(elements, where));
  if (damage == Damage::refuse) CUTICLE_TRY(require_two_points(layout, where));
  ParsedGroom parsed;
  CUTICLE_ASSIGN(parsed.groom, Builder(elements, layout, where, damage).build());
  parsed.notes.push_back(fmt::format("strands found by {}", layout.found));
  return parsed;
}

void declare(std::string& header, const char* type, std::string_view name) {
  fmt::format_to(std::back_inserter(header), "property {} {}\n", type, name);
}

void declare_attributes(std::string& header, const Groom& groom, Attribute::Domain domain) {
  for (const auto& [name, attribute] : groom.attributes) {
    if (attribute.domain != domain) continue;
    if (name == "color" && domain == Attribute::Domain::vertex && attribute.components == 3)
      for (const char* channel : {"red", "green", "blue"}) declare(header, "float", channel);
    else
      for (int c = 0; c < attribute.components; ++c)
        declare(header, "float", attribute.components == 1 ? name : fmt::format("{}_{}", name, c));
  }
}

std::string header_of(const Groom& groom) {
  std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", groom.vertex_count());
  for (const char* name : {"x", "y", "z", "radius"}) declare(header, "float", name);
  declare_attributes(header, groom, Attribute::Domain::vertex);
  header += fmt::format("element strand {}\n", groom.strand_count());
  declare(header, "ushort", "nsegs");
  if (!groom.root_uv.empty())
    for (const char* name : {"root_u", "root_v"}) declare(header, "float", name);
  if (!groom.root_triangle.empty()) declare(header, "uint", "root_triangle");
  if (!groom.root_barycentrics.empty())
    for (const char* name : {"root_b", "root_c"}) declare(header, "float", name);
  declare_attributes(header, groom, Attribute::Domain::strand);
  header += fmt::format("element edge {}\n", groom.vertex_count() - groom.strand_count());
  for (const char* name : {"vertex1", "vertex2"}) declare(header, "int", name);
  return header + "end_header\n";
}

void append_attributes(std::vector<std::byte>& bytes, const Groom& groom, Attribute::Domain domain, std::size_t row) {
  for (const auto& [name, attribute] : groom.attributes)
    if (attribute.domain == domain)
      for (std::size_t c = 0; c < std::size_t(attribute.components); ++c)
        append(bytes, attribute.values[row * std::size_t(attribute.components) + c]);
}

void append_strand(std::vector<std::byte>& bytes, const Groom& groom, std::size_t s) {
  append(bytes, std::uint16_t(groom.strand_size(s) - 1));
  if (!groom.root_uv.empty()) append(bytes, groom.root_uv[s]);
  if (!groom.root_triangle.empty()) append(bytes, groom.root_triangle[s]);
  if (!groom.root_barycentrics.empty()) append(bytes, groom.root_barycentrics[s]);
  append_attributes(bytes, groom, Attribute::Domain::strand, s);
}

Result<std::vector<std::byte>> format_ply(const Groom& groom, double) {
  std::vector<std::byte> bytes = to_bytes(header_of(groom));
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) {
    append(bytes, groom.positions[v]);
    append(bytes, groom.radii[v]);
    append_attributes(bytes, groom, Attribute::Domain::vertex, v);
  }
  for (std::size_t s = 0; s < groom.strand_count(); ++s) append_strand(bytes, groom, s);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v) {
      append(bytes, v);
      append(bytes, v + 1);
    }
  return bytes;
}

constexpr std::string_view k_extensions[] = {"ply"};

}  // namespace

const Format& entry() {
  static const Format format{
      .name = "ply",
      .extensions = k_extensions,
      .summary = "PLY: elements 'strand' or 'edge', or a point cloud with 100 points or one colour a strand",
      .holds = {.most_points = 65536, .widths = Widths::vertices, .root_uv = true, .roots = true, .attributes = true},
      .parse = parse,
      .format = format_ply};
  return format;
}

}  // namespace cuticle::strands::ply
