#include "bsdf/measured/measured.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include <fmt/core.h>
#include <glm/trigonometric.hpp>

#include "core/file.h"
#include "core/points/points_file.h"

namespace cuticle::bsdf {
namespace {

constexpr double k_most = 1e30;
enum Column : std::size_t {
  theta_i_column,
  theta_o_column,
  phi_column,
  value_column,
  r_column,
  g_column,
  b_column,
  sigma_column
};
constexpr PointColumn k_columns[] = {{"theta_i", -90, 90, "deg"}, {"theta_o", -90, 90, "deg"},
                                     {"phi", -360, 360, "deg"},   {"value", -k_most, k_most, "1"},
                                     {"r", -k_most, k_most, "1"}, {"g", -k_most, k_most, "1"},
                                     {"b", -k_most, k_most, "1"}, {"sigma", 1e-30, k_most, "1"}};

/// Place of a column in a row of the table.
std::optional<std::size_t> place_of(const PointsTable& table, std::size_t column) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i] == column) return i;
  return {};
}

Result<void> check_columns(const PointsTable& table, std::string_view file) {
  for (const std::size_t column : {theta_i_column, theta_o_column, phi_column})
    if (!place_of(table, column)) return bad_input(fmt::format("{}: no column {}", file, k_columns[column].name));
  const bool rgb = place_of(table, r_column) && place_of(table, g_column) && place_of(table, b_column);
  if (rgb == bool(place_of(table, value_column)))
    return bad_input(fmt::format("{}: the measured numbers are one column value, or r, g and b", file));
  return {};
}

/// Little-endian number of `bytes` at `offset`, which holds one.
template <class T>
T number_at(std::span<const std::byte> bytes, std::size_t offset) {
  static_assert(std::endian::native == std::endian::little);
  T number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

constexpr std::size_t k_header = 3 * sizeof(std::int32_t);

/// Cells along theta_i, theta_o and phi.
struct Cells {
  std::size_t theta_i = 0, theta_o = 0, phi = 0;
  std::size_t count() const { return theta_i * theta_o * phi; }
};

Result<Cells> parse_counts(std::span<const std::byte> bytes, std::string_view file) {
  if (bytes.size() < k_header)
    return bad_input(
        fmt::format("{}: {} bytes are no table; its three counts alone take {}", file, bytes.size(), k_header));
  std::size_t counts[3] = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto count = number_at<std::int32_t>(bytes, k * sizeof(std::int32_t));
    if (count < 1 || count > 1440)
      return bad_input(fmt::format("{}: byte {}: count {} is outside 1 .. 1440", file, k * sizeof count, count));
    counts[k] = std::size_t(count);
  }
  const Cells cells{counts[0], counts[1], counts[2]};
  const std::size_t expected = k_header + 3 * cells.count() * sizeof(double);
  if (bytes.size() != expected)
    return bad_input(fmt::format("{}: {} bytes, but a table of {} x {} x {} cells takes {}", file, bytes.size(),
                                 cells.theta_i, cells.theta_o, cells.phi, expected));
  return cells;
}

/// Red, green and blue of a cell.
Result<glm::dvec3> color_of(std::span<const std::byte> bytes, const Cells& cells, std::size_t cell,
                            std::string_view file) {
  glm::dvec3 color;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t offset = k_header + (c * cells.count() + cell) * sizeof(double);
    color[int(c)] = number_at<double>(bytes, offset);
    if (!std::isfinite(color[int(c)]) || color[int(c)] > k_most)
      return bad_input(fmt::format("{}: byte {}: {} is not a measured number", file, offset, color[int(c)]));
  }
  return color;
}

/// The middle of cell `index` of `count` over 180 degrees from `begin`.
double middle(std::size_t index, std::size_t count, double begin) {
  return glm::radians(begin + 180 * (double(index) + 0.5) / double(count));
}

}  // namespace

Result<MeasuredFormat> find_measured_format(std::string_view name) {
  if (name == "gantry") return MeasuredFormat::gantry;
  if (name == "csv") return MeasuredFormat::csv;
  if (name == "slices") return MeasuredFormat::slices;
  return usage_error(fmt::format("'{}' is no format of measurements", name), "gantry, csv or slices");
}

Result<MeasuredFibre> parse_measured_csv(std::string_view text, std::string_view file) {
  CUTICLE_ASSIGN(const PointsTable table, parse_points(text, file, k_columns));
  CUTICLE_TRY(check_columns(table, file));
  MeasuredFibre fibre;
  fibre.one_number = bool(place_of(table, value_column));
  fibre.sigma_known = bool(place_of(table, sigma_column));
  for (const std::vector<double>& row : table.rows) {
    const auto cell = [&](std::size_t column) {
      const auto place = place_of(table, column);
      return place ? row[*place] : 0.0;
    };
    const glm::dvec3 color =
        fibre.one_number ? glm::dvec3(cell(value_column)) : glm::dvec3(cell(r_column), cell(g_column), cell(b_column));
    fibre.directions.push_back({glm::radians(cell(theta_i_column)), glm::radians(cell(theta_o_column)),
                                glm::radians(cell(phi_column)), color, cell(sigma_column)});
  }
  return fibre;
}

Result<MeasuredFibre> parse_slices(std::span<const std::byte> bytes, std::string_view file) {
  CUTICLE_ASSIGN(const Cells cells, parse_counts(bytes, file));
  MeasuredFibre fibre;
  fibre.one_number = false;
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    CUTICLE_ASSIGN(const glm::dvec3 color, color_of(bytes, cells, cell, file));
    const std::size_t phi = cell % cells.phi, o = cell / cells.phi % cells.theta_o,
                      i = cell / cells.phi / cells.theta_o;
    if (color.x < 0 || color.y < 0 || color.z < 0)
      ++fibre.unmeasured;
    else
      fibre.directions.push_back(
          {middle(i, cells.theta_i, -90), middle(o, cells.theta_o, -90), middle(phi, cells.phi, 0), color});
  }
  if (fibre.directions.empty()) return bad_input(fmt::format("{}: no measured value", file));
  return fibre;
}

Result<MeasuredFibre> read_measured(const std::string& path, std::string_view format, const Gantry& gantry) {
  const auto ends = [&](std::string_view end) { return path.ends_with(end); };
  if (format.empty()) format = ends(".csv") ? "csv" : ends(".bin") || ends(".binary") ? "slices" : "gantry";
  CUTICLE_ASSIGN(const MeasuredFormat known, find_measured_format(format));
  if (known == MeasuredFormat::slices) {
    CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
    return parse_slices(bytes, path);
  }
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  return known == MeasuredFormat::csv ? parse_measured_csv(text, path) : parse_gantry(text, path, gantry);
}

}  // namespace cuticle::bsdf
