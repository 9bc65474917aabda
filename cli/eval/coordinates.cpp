#include "cli/eval/coordinates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "cli/command.h"

namespace cuticle::cli {
namespace {

constexpr std::size_t coordinates = bsdf::coordinate_count;
constexpr std::size_t most_points = 5'000'000;
constexpr std::size_t phi_o = 5;
constexpr std::array<double bsdf::Point::*, coordinates> members = {&bsdf::Point::theta_i, &bsdf::Point::theta_o,
                                                                    &bsdf::Point::theta_d, &bsdf::Point::phi,
                                                                    &bsdf::Point::h,       &bsdf::Point::phi_o};

Result<void> check_grid(const CoordinateRequest& request) {
  for (std::size_t c = 0; c < coordinates; ++c) {
    const bool given = !request.grid[c].empty();
    if (given && !request.needed[c] && request.refuse_unused && c != phi_o)
      return usage_error(fmt::format("{} has no use for {}", request.quantity, coordinate_flag(c)));
    if (!given && request.needed[c])
      return usage_error(fmt::format("{} needs {}, in {}", request.quantity, coordinate_flag(c),
                                     eval_columns[c].unit == "1" ? "fibre radii" : "degrees"),
                         coordinate_flag(c) + " from:to:count, or --points FILE.csv");
  }
  return {};
}

/// The rows of the table times the values of one more coordinate.
Result<void> multiply(PointsTable& table, std::size_t coordinate, const std::string& text) {
  const std::string flag = coordinate_flag(coordinate);
  CUTICLE_ASSIGN(const std::vector<double> values, parse_numbers(flag, text));
  if (table.rows.size() * values.size() > most_points)
    return usage_error(fmt::format("the grid has more than {} points", most_points), "fewer values, or several runs");
  PointsTable product{table.columns, {}};
  product.columns.push_back(coordinate);
  for (const std::vector<double>& row : table.rows)
    for (double value : values) {
      if (const auto checked = check_range(eval_columns[coordinate], value, flag); !checked)
        return usage_error(checked.error().message);
      product.rows.push_back(row);
      product.rows.back().push_back(value);
    }
  table = std::move(product);
  return {};
}

Result<PointsTable> grid_points(const CoordinateRequest& request) {
  CUTICLE_TRY(check_grid(request));
  PointsTable table{{}, {{}}};
  for (std::size_t c = 0; c < coordinates; ++c)
    if (!request.grid[c].empty()) CUTICLE_TRY(multiply(table, c, request.grid[c]));
  return table;
}

Result<PointsTable> file_points(const CoordinateRequest& request) {
  for (std::size_t c = 0; c < coordinates; ++c)
    if (!request.grid[c].empty())
      return usage_error(fmt::format("{} and --points exclude each other", coordinate_flag(c)));
  CUTICLE_ASSIGN(PointsTable table, read_points(request.points_file, eval_columns));
  for (std::size_t c = 0; c < coordinates; ++c)
    if (request.needed[c] && std::find(table.columns.begin(), table.columns.end(), c) == table.columns.end())
      return bad_input(
          fmt::format("{}: no column {}, which {} needs", request.points_file, eval_columns[c].name, request.quantity));
  return table;
}

}  // namespace

std::string coordinate_flag(std::size_t coordinate) {
  std::string name = fmt::format("--{}", eval_columns[coordinate].name);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

Result<PointsTable> read_coordinates(const CoordinateRequest& request) {
  return request.points_file.empty() ? grid_points(request) : file_points(request);
}

bool all_below_pi(const PointsTable& table) {
  double largest = 0;
  for (const std::vector<double>& row : table.rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      if (eval_columns[table.columns[c]].unit == "deg") largest = std::max(largest, std::abs(row[c]));
  return largest > 0 && largest <= std::numbers::pi;
}

std::vector<bsdf::Point> in_radians(const PointsTable& table) {
  std::vector<bsdf::Point> points(table.rows.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::size_t column = table.columns[c];
      points[i].*members[column] = table.rows[i][c] * (eval_columns[column].unit == "deg" ? std::numbers::pi / 180 : 1);
    }
  return points;
}

}  // namespace cuticle::cli
