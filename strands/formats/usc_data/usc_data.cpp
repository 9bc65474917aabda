// USC-HairSalon's .data: i32 strands, then per strand i32 points and three f32 a point, little-endian.
#include <fmt/core.h>

#include "strands/formats/bytes.h"

namespace cuticle::strands::usc_data {

namespace {

/// The points of the strand at `offset`.
Result<std::uint32_t> strand_size(const ByteView& bytes, std::uint32_t strand, std::uint64_t offset) {
  const std::string field = fmt::format("points of strand {}", strand);
  if (!bytes.has(offset, 4)) return bytes.error(field, offset, "the file ends before it");
  const std::uint32_t size = bytes.at<std::uint32_t>(offset);
  const std::uint64_t room = (bytes.size() - offset - 4) / 12;
  if (size > room) return bytes.error(field, offset, fmt::format("{}, allowed 0 .. {}", size, room));
  return size;
}

Result<std::uint32_t> strand_count(const ByteView& bytes) {
  if (!bytes.has(0, 4))
    return bytes.error("strand count", 0, fmt::format("{} bytes, at least 4 are needed", bytes.size()));
  const std::uint32_t strands = bytes.at<std::uint32_t>(0);
  const std::uint64_t room = (bytes.size() - 4) / 4;
  if (strands < 1 || strands > room)
    return bytes.error("strand count", 0,
                       fmt::format("{}, allowed 1 .. {} in a file of {} bytes", strands, room, bytes.size()));
  return strands;
}

Result<ParsedGroom> parse(std::span<const std::byte> data, const std::string& where, Damage damage) {
  const ByteView bytes(data, where);
  CUTICLE_ASSIGN(const std::uint32_t strands, strand_count(bytes));
  ParsedGroom parsed;
  Groom& groom = parsed.groom;
  std::uint64_t offset = 4;
  std::uint32_t bald = 0;
  for (std::uint32_t s = 0; s < strands; ++s) {
    CUTICLE_ASSIGN(const std::uint32_t size, strand_size(bytes, s, offset));
    offset += 4;
    if (size > 1) {
      CUTICLE_ASSIGN(const std::vector<glm::vec3> points,
                     read_array<glm::vec3>(bytes, fmt::format("strand {}", s), offset, size, damage));
      groom.positions.insert(groom.positions.end(), points.begin(), points.end());
      groom.offsets.push_back(std::uint32_t(groom.positions.size()));
    }
    bald += size < 2;
    offset += 12 * std::uint64_t(size);
  }
  if (groom.strand_count() == 0) return bytes.error("strands", 4, "none has two points");
  groom.radii.assign(groom.vertex_count(), 0.0f);
  if (bald > 0) parsed.notes.push_back(fmt::format("{} of {} roots have no strand: left out", bald, strands));
  return parsed;
}

Result<std::vector<std::byte>> format_data(const Groom& groom, double) {
  std::vector<std::byte> bytes;
  bytes.reserve(4 + 4 * groom.strand_count() + 12 * groom.vertex_count());
  append(bytes, std::uint32_t(groom.strand_count()));
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    append(bytes, std::uint32_t(groom.strand_size(s)));
    append_all(bytes, groom.strand(s));
  }
  return bytes;
}

constexpr std::string_view k_extensions[] = {"data"};

}  // namespace

const Format& entry() {
  static const Format format{.name = "usc_data",
                             .extensions = k_extensions,
                             .summary = "USC-HairSalon's .data",
                             .holds = {},
                             .parse = parse,
                             .format = format_data};
  return format;
}

}  // namespace cuticle::strands::usc_data
