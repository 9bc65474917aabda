#pragma once
// Reference tables of the tests: a header line, then rows of numbers and words without quotes.
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace cuticle::tests {

/// A row by column name.
class CsvRow {
 public:
  explicit CsvRow(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  const std::string& text(const std::string& column) const { return cells_.at(column); }
  double number(const std::string& column) const { return std::strtod(text(column).c_str(), nullptr); }
  unsigned long whole(const std::string& column) const { return std::strtoul(text(column).c_str(), nullptr, 10); }

 private:
  std::map<std::string, std::string> cells_;
};

inline std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// All rows of a file below the source folder; throws where it is missing or a row has the wrong length.
inline std::vector<CsvRow> read_csv(const std::string& path) {
  std::ifstream stream(path);
  std::string line;
  if (!std::getline(stream, line)) throw std::runtime_error("no table in " + path);
  const std::vector<std::string> columns = csv_cells(line);
  std::vector<CsvRow> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != columns.size()) throw std::runtime_error("a row of another length in " + path);
    std::map<std::string, std::string> row;
    for (std::size_t c = 0; c < cells.size(); ++c) row[columns[c]] = cells[c];
    rows.emplace_back(std::move(row));
  }
  return rows;
}

}  // namespace cuticle::tests
