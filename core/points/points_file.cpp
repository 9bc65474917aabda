#include "core/points/points_file.h"

#include <algorithm>
#include <charconv>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/file.h"
#include "core/registry/parameter.h"

namespace cuticle {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// The text up to `separator`, taken off the front of `rest`.
std::string_view take_until(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

std::vector<std::string_view> split_cells(std::string_view line) {
  std::vector<std::string_view> cells;
  const std::size_t count = std::size_t(std::count(line.begin(), line.end(), ',')) + 1;
  for (std::size_t i = 0; i < count; ++i) cells.push_back(trimmed(take_until(line, ',')));
  return cells;
}

Error unknown_column(std::string_view name, std::string_view where, std::span<const PointColumn> known) {
  std::vector<std::string_view> names;
  for (const PointColumn& column : known) names.push_back(column.name);
  const std::string near = registry::nearest_name(name, names);
  return bad_input(fmt::format("{}: unknown column '{}' (known: {})", where, name, fmt::join(names, ", ")),
                   near.empty() ? std::string() : fmt::format("did you mean {}?", near));
}

Result<std::vector<std::size_t>> parse_header(std::string_view line, std::string_view where,
                                              std::span<const PointColumn> known) {
  std::vector<std::size_t> columns;
  for (std::string_view name : split_cells(line)) {
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const PointColumn& column) { return column.name == name; });
    if (found == known.end()) return unknown_column(name, where, known);
    const std::size_t index = std::size_t(found - known.begin());
    if (std::find(columns.begin(), columns.end(), index) != columns.end())
      return bad_input(fmt::format("{}: column '{}' is given twice", where, name));
    columns.push_back(index);
  }
  return columns;
}

Result<double> parse_word(const PointColumn& column, std::string_view text, std::string_view where) {
  const auto found = std::ranges::find(column.words, text);
  if (found != column.words.end()) return double(found - column.words.begin());
  return bad_input(
      fmt::format("{}, column {}: '{}' is not one of {}", where, column.name, text, fmt::join(column.words, ", ")));
}

Result<double> parse_cell(const PointColumn& column, std::string_view text, std::string_view where) {
  if (!column.words.empty()) return parse_word(column, text, where);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size())
    return bad_input(fmt::format("{}, column {}: '{}' is not a number", where, column.name, text));
  CUTICLE_TRY(check_range(column, value, where));
  return value;
}

Result<std::vector<double>> parse_row(std::string_view line, std::string_view where, std::span<const PointColumn> known,
                                      const std::vector<std::size_t>& columns) {
  const std::vector<std::string_view> cells = split_cells(line);
  if (cells.size() != columns.size())
    return bad_input(fmt::format("{}: {} cells, but the header names {} columns", where, cells.size(), columns.size()));
  std::vector<double> row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    CUTICLE_ASSIGN(double value, parse_cell(known[columns[i]], cells[i], where));
    row.push_back(value);
  }
  return row;
}

}  // namespace

Result<void> check_range(const PointColumn& column, double value, std::string_view where) {
  if (value >= column.minimum && value <= column.maximum) return {};
  return bad_input(fmt::format("{}, column {}: {} is outside {} .. {} {}", where, column.name, value, column.minimum,
                               column.maximum, column.unit == "1" ? "" : column.unit));
}

Result<PointsTable> parse_points(std::string_view text, std::string_view file, std::span<const PointColumn> known) {
  PointsTable table;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_until(text, '\n'));
    if (line.empty()) continue;
    const std::string where = fmt::format("{}: line {}", file, number);
    if (table.columns.empty()) {
      CUTICLE_ASSIGN(table.columns, parse_header(line, where, known));
      continue;
    }
    CUTICLE_ASSIGN(std::vector<double> row, parse_row(line, where, known, table.columns));
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty())
    return bad_input(fmt::format("{}: no rows of points", file), "a header line, then one point per line");
  return table;
}

Result<PointsTable> read_points(const std::string& path, std::span<const PointColumn> known) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  return parse_points(text, path, known);
}

}  // namespace cuticle
