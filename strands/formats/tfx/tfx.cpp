// TressFX .tfx, versions 3 (float3 positions at byte 296) and 4 (float4 positions and root uv at stated offsets).
#include "strands/formats/formats.h"

#include <filesystem>

#include <fmt/core.h>

#include "core/file.h"
#include "core/mapped_file.h"
#include "strands/finite.h"
#include "strands/formats/bytes.h"
#include "strands/formats/tfx/bones.h"

namespace cuticle::strands {

namespace {

enum TfxOffset : std::uint64_t {
  version_at = 0,
  tfx_strand_count_at = 4,
  strand_size_at = 8,
  positions_offset_at = 12,
  uv_offset_at = 16,
  header_size_4 = 160,
  header_size_3 = 296
};

struct TfxHeader {
  int version = 3;
  std::uint32_t strands = 0, strand_size = 0;
  std::uint64_t positions = header_size_3, uv = 0;  ///< uv 0: none
  std::uint64_t vertex_bytes() const { return version == 3 ? 12 : 16; }
  std::uint64_t vertices() const { return std::uint64_t(strands) * strand_size; }
};

Result<int> read_version(const ByteView& bytes) {
  if (bytes.size() < header_size_4)
    return bytes.error("header", 0,
                       fmt::format("{} bytes, a .tfx header has 160 (version 4) or 296 (version 3)", bytes.size()));
  const float version = bytes.at<float>(version_at);
  if (version >= 3 && version < 4 && bytes.size() < header_size_3)
    return bytes.error("header", 0, fmt::format("{} bytes, a version 3 header has 296", bytes.size()));
  if (version >= 3 && version < 5) return int(version);
  return bytes.error("version", version_at, fmt::format("{}, allowed 3 <= version < 5", double(version)));
}

Result<void> read_offsets(const ByteView& bytes, TfxHeader& header) {
  if (header.version == 3) return {};
  header.positions = bytes.at<std::uint32_t>(positions_offset_at);
  header.uv = bytes.at<std::uint32_t>(uv_offset_at);
  if (header.positions < header_size_4 || header.positions > bytes.size())
    return bytes.error(
        "position offset", positions_offset_at,
        fmt::format("{}, allowed {} .. {}", header.positions, std::uint64_t(header_size_4), bytes.size()));
  if (header.uv != 0 && (header.uv < header_size_4 || header.uv > bytes.size()))
    return bytes.error("uv offset", uv_offset_at,
                       fmt::format("{}, allowed 0 or {} .. {}", header.uv, std::uint64_t(header_size_4), bytes.size()));
  return {};
}

Result<TfxHeader> read_header(const ByteView& bytes) {
  TfxHeader header;
  CUTICLE_ASSIGN(header.version, read_version(bytes));
  CUTICLE_TRY(read_offsets(bytes, header));
  header.strands = bytes.at<std::uint32_t>(tfx_strand_count_at);
  header.strand_size = bytes.at<std::uint32_t>(strand_size_at);
  const std::uint64_t room = (bytes.size() - header.positions) / header.vertex_bytes();
  if (header.strand_size < 2 || header.strand_size > room)
    return bytes.error(
        "points per strand", strand_size_at,
        fmt::format("{}, allowed 2 .. {} in a file of {} bytes", header.strand_size, room, bytes.size()));
  if (header.strands < 1 || header.strands > room / header.strand_size)
    return bytes.error("strand count", tfx_strand_count_at,
                       fmt::format("{} strands of {} points, allowed 1 .. {} strands in a file of {} bytes",
                                   header.strands, header.strand_size, room / header.strand_size, bytes.size()));
  return header;
}

std::vector<std::uint32_t> even_offsets(const TfxHeader& header) {
  std::vector<std::uint32_t> offsets(std::size_t(header.strands) + 1);
  for (std::size_t s = 0; s < offsets.size(); ++s) offsets[s] = std::uint32_t(s * header.strand_size);
  return offsets;
}

/// The usual w of a vertex: 0 (pinned) at the root, 1 elsewhere.
float usual_pin(std::size_t place_in_strand) { return place_in_strand == 0 ? 0.0f : 1.0f; }

/// Of points of version 4.
struct PointCheck {
  bool usual_pins = true, finite = true;
};
/// In blocks: each is checked while it is in the cache.
PointCheck read_pinned_positions(const ByteView& bytes, const TfxHeader& header, Groom& groom) {
  reserve_large(groom.positions, header.vertices());
  PointCheck check;
  glm::vec3 block[1024];
  const std::byte* at = bytes.data() + header.positions;
  std::uint32_t place = 0;  // in the strand
  for (std::uint64_t first = 0; first < header.vertices(); first += std::size(block)) {
    const std::uint64_t size = std::min<std::uint64_t>(std::size(block), header.vertices() - first);
    for (std::uint64_t k = 0; k < size; ++k, at += header.vertex_bytes()) {
      float point[4];
      std::memcpy(point, at, sizeof(point));
      block[k] = {point[0], point[1], point[2]};
      check.usual_pins &= point[3] == usual_pin(place);
      place = place + 1 == header.strand_size ? 0 : place + 1;
    }
    check.finite &= all_finite({&block[0].x, 3 * size});
    groom.positions.insert(groom.positions.end(), block, block + size);
  }
  return check;
}

Result<void> read_version_4(const ByteView& bytes, const TfxHeader& header, Damage damage, Groom& groom) {
  const std::uint64_t count = header.vertices();
  const PointCheck check = read_pinned_positions(bytes, header, groom);
  if (check.usual_pins && (damage == Damage::keep || check.finite)) return {};
  CUTICLE_ASSIGN(const std::vector<float> numbers,
                 read_array<float>(bytes, "positions", header.positions, 4 * count, damage));
  std::vector<float> w(count);
  for (std::uint64_t v = 0; v < count; ++v) w[v] = numbers[4 * v + 3];
  groom.attributes["movability"] = {Attribute::Domain::vertex, 1, std::move(w)};
  return {};
}

Result<void> read_positions(const ByteView& bytes, const TfxHeader& header, Damage damage, Groom& groom) {
  CUTICLE_TRY(require_floats(bytes, "positions", header.positions, header.vertices() * header.vertex_bytes() / 4));
  if (header.version == 4) return read_version_4(bytes, header, damage, groom);
  CUTICLE_ASSIGN(groom.positions,
                 read_array<glm::vec3>(bytes, "positions", header.positions, header.vertices(), damage));
  return {};
}

Result<void> read_root_uv(const ByteView& bytes, const TfxHeader& header, Damage damage, Groom& groom) {
  if (header.uv == 0) return {};
  CUTICLE_ASSIGN(groom.root_uv, read_array<glm::vec2>(bytes, "root uv", header.uv, header.strands, damage));
  return {};
}

std::vector<std::byte> format_header(const Groom& groom, int version) {
  std::vector<std::byte> bytes;
  append(bytes, float(version));
  append(bytes, std::uint32_t(groom.strand_count()));
  append(bytes, std::uint32_t(groom.strand_size(0)));
  if (version == 4) {
    append(bytes, std::uint32_t(header_size_4));
    const std::uint64_t end = header_size_4 + 16 * std::uint64_t(groom.vertex_count());
    append(bytes, groom.root_uv.empty() ? 0u : std::uint32_t(end));
  }
  while (bytes.size() < (version == 3 ? header_size_3 : header_size_4)) append(bytes, std::uint32_t(0));
  return bytes;
}

Result<void> check_writable(const Groom& groom, int version) {
  if (version != 3 && version != 4) return bad_input(fmt::format("tfx version {}, allowed 3 or 4", version));
  if (groom.strand_count() == 0) return bad_input("tfx: the groom has 0 strands, at least 1 is needed");
  for (std::size_t s = 1; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) != groom.strand_size(0))
      return bad_input(fmt::format("tfx: strand {} has {} points, strand 0 has {}; a .tfx needs equal counts", s,
                                   groom.strand_size(s), groom.strand_size(0)),
                       "write a .hair file, or smooth the strands to one vertex count first");
  if (groom.vertex_count() > (0xffffffffull - header_size_4) / 16)
    return bad_input(fmt::format("tfx: {} points pass the 32-bit offsets of the format", groom.vertex_count()));
  return {};
}

constexpr std::string_view k_extensions[] = {"tfx"};
constexpr NamedAttribute k_attributes[] = {{"movability", 1}};

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  CUTICLE_ASSIGN(Groom groom, parse_tfx(bytes, where, damage));
  return ParsedGroom{std::move(groom)};
}

/// The file, and its bones where a .tfxbone of the same name lies beside it.
Result<ParsedGroom> read(const std::string& path, Damage damage) {
  CUTICLE_ASSIGN(const FileBytes bytes, map_file(path));
  CUTICLE_ASSIGN(ParsedGroom parsed, parse(bytes.span(), path, damage));
  const std::string companion = std::filesystem::path(path).replace_extension(".tfxbone").string();
  std::error_code ignored;
  if (!std::filesystem::exists(companion, ignored)) return parsed;
  CUTICLE_ASSIGN(const std::vector<std::byte> bone_bytes, read_file(companion));
  CUTICLE_ASSIGN(const BoneWeights weights, parse_tfxbone(bone_bytes, companion));
  CUTICLE_TRY(add_bones(weights, companion, parsed));
  return parsed;
}

Result<std::vector<std::byte>> format(const Groom& groom, double) { return format_tfx(groom, 4); }

}  // namespace

Result<Groom> parse_tfx(std::span<const std::byte> data, const std::string& where, Damage damage) {
  const ByteView bytes(data, where);
  CUTICLE_ASSIGN(const TfxHeader header, read_header(bytes));
  if (header.vertices() > 0xffffffffull)
    return bytes.error("strand count", tfx_strand_count_at,
                       fmt::format("{} points in all, allowed 2 .. {}", header.vertices(), 0xffffffffull));
  Groom groom;
  groom.offsets = even_offsets(header);
  CUTICLE_TRY(read_positions(bytes, header, damage, groom));
  reserve_large(groom.radii, groom.positions.size());
  groom.radii.assign(groom.positions.size(), 0.0f);
  CUTICLE_TRY(read_root_uv(bytes, header, damage, groom));
  return groom;
}

Result<std::vector<std::byte>> format_tfx(const Groom& groom, int version) {
  CUTICLE_TRY(check_writable(groom, version));
  std::vector<std::byte> bytes = format_header(groom, version);
  bytes.reserve(bytes.size() + 16 * groom.vertex_count() + 8 * groom.root_uv.size());
  if (version == 3) {
    append_all(bytes, std::span<const glm::vec3>(groom.positions));
    return bytes;
  }
  const auto movability = groom.attributes.find("movability");
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) {
    append(bytes, groom.positions[v]);
    append(bytes,
           movability != groom.attributes.end() ? movability->second.values[v] : usual_pin(v % groom.strand_size(0)));
  }
  append_all(bytes, std::span<const glm::vec2>(groom.root_uv));
  return bytes;
}

namespace tfx {
const Format& entry() {
  static const Format format{
      .name = "tfx",
      .extensions = k_extensions,
      .summary = "AMD TressFX, versions 3 and 4 (read), 4 (written); a .tfxbone beside it is read",
      .holds = {.differing_sizes = false, .root_uv = true, .named = k_attributes},
      .parse = parse,
      .format = strands::format,
      .read = read};
  return format;
}
}  // namespace tfx

}  // namespace cuticle::strands
