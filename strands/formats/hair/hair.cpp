// Cem Yuksel's .hair: a header of 128 bytes, then the arrays that its bits announce.
#include "strands/formats/formats.h"

#include <algorithm>

#include <fmt/core.h>

#include "strands/formats/bytes.h"

namespace cuticle::strands {

namespace {

enum ArrayBit : std::uint32_t { segments = 1, points = 2, thickness = 4, transparency = 8, color = 16, all = 31 };
enum HeaderOffset : std::uint64_t {
  strand_count_at = 4,
  point_count_at = 8,
  arrays_at = 12,
  default_segments_at = 16,
  default_thickness_at = 20,
  default_transparency_at = 24,
  default_color_at = 28,
  info_at = 40,
  header_size = 128
};

struct Header {
  std::uint32_t strands = 0, points = 0, arrays = 0, segments = 0;
  float thickness = 0, transparency = 0;
  std::vector<float> color;
  bool has(ArrayBit bit) const { return (arrays & bit) != 0; }
};

Result<void> check_signature(const ByteView& bytes) {
  if (bytes.size() < header_size)
    return bytes.error("header", 0, fmt::format("{} bytes, a .hair header has 128", bytes.size()));
  const char signature[4] = {'H', 'A', 'I', 'R'};
  for (std::uint64_t i = 0; i < 4; ++i)
    if (bytes.at<char>(i) != signature[i]) return bytes.error("signature", 0, "must be \"HAIR\"");
  return {};
}

Result<void> check_counts(const ByteView& bytes, const Header& header, Damage damage) {
  const std::uint64_t room = bytes.size() - header_size;
  const std::uint64_t points_per_strand = damage == Damage::keep ? 1 : 2;
  const std::uint64_t per_strand = 12 * points_per_strand + (header.has(segments) ? 2 : 0);
  if (header.arrays & ~std::uint32_t(all))
    return bytes.error("arrays", arrays_at, fmt::format("{:#x} has unknown bits, allowed 0 .. 0x1f", header.arrays));
  if (!header.has(points)) return bytes.error("arrays", arrays_at, "bit 1 (points) is not set: there are no positions");
  if (header.strands < 1 || header.strands > room / per_strand)
    return bytes.error("hair_count", strand_count_at,
                       fmt::format("{} strands of {} points in all; at least 1, and {} bytes hold at most {} strands",
                                   header.strands, header.points, bytes.size(), room / per_strand));
  const std::uint64_t least = points_per_strand * header.strands;
  if (header.points < least || header.points > room / 12)
    return bytes.error("point_count", point_count_at,
                       fmt::format("{} points, allowed {} .. {} for {} strands in {} bytes", header.points, least,
                                   room / 12, header.strands, bytes.size()));
  return {};
}

Result<Header> read_header(const ByteView& bytes, Damage damage) {
  CUTICLE_TRY(check_signature(bytes));
  Header header;
  header.strands = bytes.at<std::uint32_t>(strand_count_at);
  header.points = bytes.at<std::uint32_t>(point_count_at);
  header.arrays = bytes.at<std::uint32_t>(arrays_at);
  header.segments = bytes.at<std::uint32_t>(default_segments_at);
  CUTICLE_TRY(check_counts(bytes, header, damage));
  CUTICLE_ASSIGN(std::vector<float> defaults,
                 read_array<float>(bytes, "d_thickness, d_transparency, d_color", default_thickness_at, 5));
  header.thickness = defaults[0];
  header.transparency = defaults[1];
  header.color.assign(defaults.begin() + 2, defaults.end());
  return header;
}

/// Segments of a strand.
std::uint32_t segments_of(const ByteView& bytes, const Header& header, std::uint32_t strand) {
  return header.has(segments) ? bytes.at<std::uint16_t>(header_size + 2 * std::uint64_t(strand)) : header.segments;
}

/// At the field that states the segments of a strand.
Error segments_error(const ByteView& bytes, const Header& header, std::uint32_t strand, const std::string& problem) {
  if (!header.has(segments)) return bytes.error("d_segments", default_segments_at, problem);
  return bytes.error(fmt::format("segments[{}]", strand), header_size + 2 * std::uint64_t(strand), problem);
}

Result<std::vector<std::uint32_t>> read_offsets(const ByteView& bytes, const Header& header, Damage damage) {
  std::vector<std::uint32_t> offsets{0};
  offsets.reserve(std::size_t(header.strands) + 1);
  for (std::uint32_t s = 0; s < header.strands; ++s) {
    const std::uint32_t count = segments_of(bytes, header, s);
    if ((count < 1 && damage == Damage::refuse) || count > 65535)
      return segments_error(
          bytes, header, s,
          fmt::format("strand {} has {} segments ({} points), allowed 1 .. 65535", s, count, std::uint64_t(count) + 1));
    const std::uint64_t end = std::uint64_t(offsets.back()) + count + 1;
    if (end > header.points)
      return segments_error(bytes, header, s,
                            fmt::format("strands 0 .. {} have {} points, point_count is {}", s, end, header.points));
    offsets.push_back(std::uint32_t(end));
  }
  if (offsets.back() != header.points)
    return bytes.error("point_count", point_count_at,
                       fmt::format("{}, but the segments add up to {} points", header.points, offsets.back()));
  return offsets;
}

/// Reads one array and moves `offset` past it.
template <class T>
Result<std::vector<T>> next_array(const ByteView& bytes, const char* field, std::uint64_t& offset, std::uint64_t count,
                                  Damage damage) {
  const std::uint64_t begin = offset;
  offset += sizeof(T) * count;
  return read_array<T>(bytes, field, begin, count, damage);
}

Result<std::vector<float>> read_radii(const ByteView& bytes, const Header& header, std::uint64_t& offset,
                                      Damage damage) {
  if (header.thickness < 0)
    return bytes.error("d_thickness", default_thickness_at, fmt::format("{} is below 0", double(header.thickness)));
  if (!header.has(thickness)) {
    std::vector<float> radii;
    reserve_large(radii, header.points);
    radii.assign(header.points, header.thickness * 0.5f);
    return radii;
  }
  const std::uint64_t begin = offset;
  CUTICLE_ASSIGN(std::vector<float> radii, next_array<float>(bytes, "thickness", offset, header.points, damage));
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (radii[i] < 0 && damage == Damage::refuse)
      return bytes.error(fmt::format("thickness[{}]", i), begin + 4 * i,
                         fmt::format("{} is below 0", double(radii[i])));
    radii[i] *= 0.5f;
  }
  return radii;
}

/// A default that says something (not `plain`) becomes an attribute of the strands.
void add_default(Groom& groom, const char* name, const std::vector<float>& value, const std::vector<float>& plain) {
  if (value == plain) return;
  Attribute attribute{Attribute::Domain::strand, int(value.size()), {}};
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    attribute.values.insert(attribute.values.end(), value.begin(), value.end());
  groom.attributes[name] = std::move(attribute);
}

Result<void> read_attribute(const ByteView& bytes, const char* name, int components, std::uint64_t& offset,
                            Damage damage, Groom& groom) {
  const std::uint64_t count = std::uint64_t(components) * groom.vertex_count();
  CUTICLE_ASSIGN(std::vector<float> values, next_array<float>(bytes, name, offset, count, damage));
  groom.attributes[name] = {Attribute::Domain::vertex, components, std::move(values)};
  return {};
}

Result<void> read_attributes(const ByteView& bytes, const Header& header, std::uint64_t& offset, Damage damage,
                             Groom& groom) {
  add_default(groom, "transparency", {header.transparency}, {0});
  add_default(groom, "color", header.color, {1, 1, 1});
  if (header.has(transparency)) CUTICLE_TRY(read_attribute(bytes, "transparency", 1, offset, damage, groom));
  if (header.has(color)) CUTICLE_TRY(read_attribute(bytes, "color", 3, offset, damage, groom));
  return {};
}

const Attribute* find_attribute(const Groom& groom, const std::string& name, int components) {
  const auto found = groom.attributes.find(name);
  return found != groom.attributes.end() && found->second.components == components ? &found->second : nullptr;
}

/// The header's default of an attribute: the first strand's value, or `plain`.
std::vector<float> default_of(const Groom& groom, const char* name, const std::vector<float>& plain) {
  const Attribute* attribute = find_attribute(groom, name, int(plain.size()));
  if (!attribute || attribute->domain != Attribute::Domain::strand || attribute->values.size() < plain.size())
    return plain;
  return {attribute->values.begin(), attribute->values.begin() + std::ptrdiff_t(plain.size())};
}

bool varies(const Attribute& attribute) {
  const std::size_t step = std::size_t(attribute.components);
  for (std::size_t i = step; i < attribute.values.size(); ++i)
    if (attribute.values[i] != attribute.values[i - step]) return true;
  return false;
}

bool needs_array(const Attribute* attribute) {
  return attribute && (attribute->domain == Attribute::Domain::vertex || varies(*attribute));
}

bool has_equal_sizes(const Groom& groom) {
  for (std::size_t s = 1; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) != groom.strand_size(0)) return false;
  return true;
}

bool has_equal_radii(const Groom& groom) {
  return std::all_of(groom.radii.begin(), groom.radii.end(),
                     [&](float radius) { return radius == groom.radii.front(); });
}

std::uint32_t arrays_of(const Groom& groom) {
  std::uint32_t bits = points;
  if (!has_equal_sizes(groom)) bits |= segments;
  if (!has_equal_radii(groom)) bits |= thickness;
  if (needs_array(find_attribute(groom, "transparency", 1))) bits |= transparency;
  if (needs_array(find_attribute(groom, "color", 3))) bits |= color;
  return bits;
}

void append_header(std::vector<std::byte>& bytes, const Groom& groom, std::uint32_t arrays) {
  for (char c : {'H', 'A', 'I', 'R'}) append(bytes, c);
  append(bytes, std::uint32_t(groom.strand_count()));
  append(bytes, std::uint32_t(groom.vertex_count()));
  append(bytes, arrays);
  append(bytes, groom.strand_count() == 0 ? 0u : std::uint32_t(groom.strand_size(0) - 1));
  append(bytes, groom.radii.empty() ? 0.0f : groom.radii.front() * 2);
  append(bytes, default_of(groom, "transparency", {0}).front());
  for (float channel : default_of(groom, "color", {1, 1, 1})) append(bytes, channel);
  const std::string info = "written by cuticle";
  for (std::size_t i = 0; i < header_size - info_at; ++i) append(bytes, i < info.size() ? info[i] : '\0');
}

/// Values per vertex; a strand's value is repeated over its vertices.
void append_attribute(std::vector<std::byte>& bytes, const Groom& groom, const Attribute& attribute) {
  const std::size_t step = std::size_t(attribute.components);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v)
      for (std::size_t c = 0; c < step; ++c)
        append(bytes, attribute.values[(attribute.domain == Attribute::Domain::vertex ? v : s) * step + c]);
}

}  // namespace

Result<Groom> parse_hair(std::span<const std::byte> data, const std::string& where, Damage damage) {
  const ByteView bytes(data, where);
  CUTICLE_ASSIGN(const Header header, read_header(bytes, damage));
  Groom groom;
  CUTICLE_ASSIGN(groom.offsets, read_offsets(bytes, header, damage));
  std::uint64_t offset = header_size + (header.has(segments) ? 2 * std::uint64_t(header.strands) : 0);
  CUTICLE_ASSIGN(groom.positions, next_array<glm::vec3>(bytes, "points", offset, header.points, damage));
  CUTICLE_ASSIGN(groom.radii, read_radii(bytes, header, offset, damage));
  CUTICLE_TRY(read_attributes(bytes, header, offset, damage, groom));
  return groom;
}

std::vector<std::byte> format_hair(const Groom& groom) {
  const std::uint32_t arrays = arrays_of(groom);
  std::vector<std::byte> bytes;
  bytes.reserve(header_size + 2 * groom.strand_count() + 16 * groom.vertex_count());
  append_header(bytes, groom, arrays);
  if (arrays & segments)
    for (std::size_t s = 0; s < groom.strand_count(); ++s) append(bytes, std::uint16_t(groom.strand_size(s) - 1));
  append_all(bytes, std::span<const glm::vec3>(groom.positions));
  if (arrays & thickness)
    for (float radius : groom.radii) append(bytes, radius * 2);
  if (arrays & transparency) append_attribute(bytes, groom, groom.attributes.at("transparency"));
  if (arrays & color) append_attribute(bytes, groom, groom.attributes.at("color"));
  return bytes;
}

namespace hair {
namespace {

constexpr std::string_view k_extensions[] = {"hair"};
constexpr NamedAttribute k_attributes[] = {{"color", 3}, {"transparency", 1}};

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  CUTICLE_ASSIGN(Groom groom, parse_hair(bytes, where, damage));
  return ParsedGroom{std::move(groom)};
}

Result<std::vector<std::byte>> format(const Groom& groom, double) { return format_hair(groom); }

}  // namespace

const Format& entry() {
  static const Format format{.name = "hair",
                             .extensions = k_extensions,
                             .summary = "Cem Yuksel's .hair",
                             .holds = {.most_points = 65536, .widths = Widths::vertices, .named = k_attributes},
                             .parse = parse,
                             .format = hair::format};
  return format;
}
}  // namespace hair

}  // namespace cuticle::strands
