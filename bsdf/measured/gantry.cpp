// The text that Yan et al. 2015 share: http://cseweb.ucsd.edu/~viscomp/projects/fur (phi theta value, gantry angles).
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "bsdf/measured/measured.h"
#include "core/text.h"

namespace cuticle::bsdf {
namespace {

/// The next word of the line, taken off its front; empty at its end.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view blank = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(blank), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blank));
  line.remove_prefix(word.size());
  return word;
}

Result<double> parse_number(std::string_view word, std::string_view what, double least, double most,
                            const std::string& where) {
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size())
    return bad_input(fmt::format("{}: {} {} is not a number", where, what, in_quotes(word)),
                     "lines of three: phi theta value, in degrees of the gantry; ? where nothing was measured");
  if (!(value >= least && value <= most))
    return bad_input(fmt::format("{}: {} {} is outside {} .. {}", where, what, value, least, most));
  return value;
}

/// The line's direction; none where its value is `?`.
Result<std::optional<MeasuredDirection>> parse_line(std::string_view line, const std::string& where,
                                                    const Gantry& gantry) {
  CUTICLE_ASSIGN(const double phi, parse_number(take_word(line), "phi", -360, 720, where));
  CUTICLE_ASSIGN(const double theta, parse_number(take_word(line), "theta", 0, 180, where));
  const std::string_view word = take_word(line);
  std::optional<MeasuredDirection> direction;
  if (word != "?") {
    constexpr double most = 1e30;
    CUTICLE_ASSIGN(const double value, parse_number(word, "value", -most, most, where));
    direction = {glm::radians(90 - theta), gantry.theta_o, glm::radians(phi - 90), glm::dvec3(value)};
  }
  if (const std::string_view more = take_word(line); !more.empty())
    return bad_input(fmt::format("{}: {} after the value", where, in_quotes(more)));
  return direction;
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

/// An angle of the gantry in degrees, short where it is round.
double degrees(double radians, double offset) {
  const double plain = glm::degrees(radians) + offset, rounded = std::round(plain * 1e9) / 1e9;
  return std::abs(rounded - plain) < 1e-12 ? rounded : plain;
}

}  // namespace

Result<MeasuredFibre> parse_gantry(std::string_view text, std::string_view file, const Gantry& gantry) {
  MeasuredFibre fibre;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_blank(line)) continue;
    CUTICLE_ASSIGN(const auto direction, parse_line(line, fmt::format("{}: line {}", file, number), gantry));
    if (direction)
      fibre.directions.push_back(*direction);
    else
      ++fibre.unmeasured;
  }
  if (fibre.directions.empty())
    return bad_input(fmt::format("{}: no measured value", file), "lines of three: phi theta value");
  return fibre;
}

std::string gantry_text(std::span<const MeasuredDirection> directions) {
  std::string text;
  for (const MeasuredDirection& at : directions) {
    text += fmt::format("{} {} ", degrees(at.phi, 90), degrees(-at.theta_i, 90));
    text += std::isfinite(at.value.x) ? fmt::format("{}\n", at.value.x) : "?\n";
  }
  return text;
}

}  // namespace cuticle::bsdf
