#pragma once
// Words of a text, for the readers of text formats.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"

namespace cuticle::strands {

/// Takes the first line off the text; its line break is dropped.
inline std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

/// Takes the first word off the line; empty when none is left.
inline std::string_view next_word(std::string_view& line) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t\r"), line.size());
  const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// Whether the whole word is a number of the value's type, which is then set.
template <class T>
bool parse_whole(std::string_view word, T& value) {
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  return code == std::errc() && end == word.data() + word.size();
}

/// The number that the whole word is, also "nan" and "inf"; what is too small for a double is 0, too large is infinite.
inline std::optional<double> to_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size() || code == std::errc::invalid_argument) return {};
  if (code == std::errc::result_out_of_range) return word.find("e-") == word.npos ? HUGE_VAL : 0.0;
  return value;
}

/// bad_input "FILE: line N: PROBLEM".
inline Error line_error(const std::string& where, std::size_t line, const std::string& problem) {
  return bad_input(where + ": line " + std::to_string(line) + ": " + problem);
}

/// Whether a name can stand in every text format: [A-Za-z_][A-Za-z0-9_]*.
inline bool is_plain_word(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; };
  return !name.empty() && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

}  // namespace cuticle::strands
