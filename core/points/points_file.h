#pragma once
// Points given as CSV: a header line of known column names, then one row of numbers per line.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace cuticle {

/// A column that may occur, with the inclusive range of its numbers; or with its words, each standing for its place
/// among them.
struct PointColumn {
  std::string_view name;
  double minimum, maximum;
  std::string_view unit;  ///< "deg", "1", ...
  std::span<const std::string_view> words = {};
};

/// Rows in the order of the file; columns as indices into the table of PointColumn.
struct PointsTable {
  std::vector<std::size_t> columns;
  std::vector<std::vector<double>> rows;
};

/// Error (bad_input) of a number outside its column's range or not finite; `where` starts the message.
Result<void> check_range(const PointColumn& column, double value, std::string_view where);

/// Parses CSV text; `file` names it in errors. Blank lines and spaces around cells are skipped. Error: bad_input,
/// naming file, line and column, for an unknown column (with the nearest known), a column given twice, a row of the
/// wrong length, and a cell that is no number, not finite or out of range, or none of the words.
Result<PointsTable> parse_points(std::string_view text, std::string_view file, std::span<const PointColumn> known);

/// The same from a file. Error: also bad_input where it cannot be read.
Result<PointsTable> read_points(const std::string& path, std::span<const PointColumn> known);

}  // namespace cuticle
