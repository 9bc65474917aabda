// Curve text of Mitsuba 3 (shapes linearcurve and bsplinecurve): a line "x y z radius" a point, an empty line after a
// curve.
#include <iterator>

#include <fmt/core.h>

#include "strands/formats/bytes.h"
#include "strands/formats/words.h"

namespace cuticle::strands::mitsuba {

namespace {

struct Point {
  glm::vec3 position;
  float radius;
};

Result<Point> read_point(std::string_view line, const std::string& where, std::size_t number, Damage damage) {
  float values[4];
  for (float& value : values) {
    const std::string_view word = next_word(line);
    const std::optional<double> read = to_number(word);
    if (!read || (damage == Damage::refuse && !std::isfinite(float(*read))))
      return line_error(where, number,
                        fmt::format("'{}', a line holds four finite numbers: x y z radius", word.substr(0, 40)));
    value = float(*read);
  }
  if (values[3] < 0 && damage == Damage::refuse)
    return line_error(where, number, fmt::format("radius {}, must be at least 0", double(values[3])));
  if (const std::string_view more = next_word(line); !more.empty())
    return line_error(where, number, fmt::format("'{}' after the four numbers of a point", more.substr(0, 40)));
  return Point{{values[0], values[1], values[2]}, values[3]};
}

/// Ends the strand that is being read, if it has points.
Result<void> end_strand(Groom& groom, const std::string& where, std::size_t number, Damage damage) {
  const std::size_t points = groom.vertex_count() - groom.offsets.back();
  if (points == 0) return {};
  if (points < 2 && damage == Damage::refuse)
    return line_error(where, number, fmt::format("curve {} has 1 point, at least 2 are needed", groom.strand_count()));
  groom.offsets.push_back(std::uint32_t(groom.vertex_count()));
  return {};
}

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  std::string_view text = to_text(bytes);
  ParsedGroom parsed;
  Groom& groom = parsed.groom;
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::string_view line = next_line(text);
    if (std::string_view rest = line; next_word(rest).empty()) {
      CUTICLE_TRY(end_strand(groom, where, number, damage));
      continue;
    }
    CUTICLE_ASSIGN(const Point point, read_point(line, where, number, damage));
    groom.positions.push_back(point.position);
    groom.radii.push_back(point.radius);
  }
  CUTICLE_TRY(end_strand(groom, where, number, damage));
  if (groom.strand_count() == 0) return line_error(where, number, "no curve, at least 1 is needed");
  return parsed;
}

Result<std::vector<std::byte>> format_text(const Groom& groom, double) {
  std::string text;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    if (s > 0) text += '\n';
    for (std::size_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) {
      const glm::vec3& p = groom.positions[v];
      fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", p.x, p.y, p.z, groom.radii[v]);
    }
  }
  return to_bytes(text);
}

constexpr std::string_view k_extensions[] = {"curves", "txt"};

}  // namespace

const Format& entry() {
  static const Format format{.name = "mitsuba",
                             .extensions = k_extensions,
                             .summary = "curve text of Mitsuba 3: linearcurve exactly, bsplinecurve smoothed",
                             .holds = {.widths = Widths::vertices},
                             .parse = parse,
                             .format = format_text};
  return format;
}

}  // namespace cuticle::strands::mitsuba
