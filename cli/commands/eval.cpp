#include <algorithm>
#include <array>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cuticle/bsdf/model.h>
#include <cuticle/cli/command.h>
#include <cuticle/cli/points_file.h>
#include <cuticle/core/file.h>
#ifdef CUTICLE_HAS_GPU
#include <cuticle/bsdf/model_gpu.h>
#endif

namespace cuticle::cli {
namespace {

constexpr std::size_t coordinates = 5;
constexpr std::size_t most_points = 5'000'000;
constexpr std::array<PointColumn, coordinates> columns = {{{"theta_i", -90, 90, "deg"},
                                                           {"theta_o", -90, 90, "deg"},
                                                           {"theta_d", -90, 90, "deg"},
                                                           {"phi", -1e6, 1e6, "deg"},
                                                           {"h", -1, 1, "1"}}};
constexpr std::array<double bsdf::Point::*, coordinates> members = {
    &bsdf::Point::theta_i, &bsdf::Point::theta_o, &bsdf::Point::theta_d, &bsdf::Point::phi, &bsdf::Point::h};

struct EvalOptions {
  std::string models = "marschner", settings, preset, quantity = "S", lobes = "sum", points_file, precision = "f64",
              out;
  std::array<std::string, coordinates> grid;
};

/// Which coordinates a quantity is a function of.
std::array<bool, coordinates> needed(bsdf::Quantity quantity) {
  switch (quantity) {
    case bsdf::Quantity::S:
      return {true, true, false, true, false};
    case bsdf::Quantity::M:
      return {true, true, false, false, false};
    case bsdf::Quantity::N:
      return {false, false, true, true, false};
    case bsdf::Quantity::A:
      return {false, false, true, false, true};
    case bsdf::Quantity::albedo:
      break;
  }
  return {false, true, false, false, false};
}

std::string flag(std::size_t coordinate) {
  std::string name = fmt::format("--{}", columns[coordinate].name);
  for (char& c : name)
    if (c == '_') c = '-';
  return name;
}

Result<void> check_grid(const EvalOptions& options, bsdf::Quantity quantity) {
  for (std::size_t c = 0; c < coordinates; ++c) {
    const bool given = !options.grid[c].empty();
    if (given && !needed(quantity)[c])
      return usage_error(fmt::format("{} has no use for {}", options.quantity, flag(c)));
    if (!given && needed(quantity)[c])
      return usage_error(fmt::format("{} needs {}, in {}", options.quantity, flag(c),
                                     columns[c].unit == "1" ? "fibre radii" : "degrees"),
                         flag(c) + " from:to:count, or --points FILE.csv");
  }
  return {};
}

/// The rows of the table times the values of one more coordinate.
Result<void> multiply(PointsTable& table, std::size_t coordinate, const std::string& text) {
  CUTICLE_ASSIGN(const std::vector<double> values, parse_numbers(flag(coordinate), text));
  if (table.rows.size() * values.size() > most_points)
    return usage_error(fmt::format("the grid has more than {} points", most_points), "fewer values, or several runs");
  PointsTable product{table.columns, {}};
  product.columns.push_back(coordinate);
  for (const std::vector<double>& row : table.rows)
    for (double value : values) {
      if (const auto checked = check_range(columns[coordinate], value, flag(coordinate)); !checked)
        return usage_error(checked.error().message);
      product.rows.push_back(row);
      product.rows.back().push_back(value);
    }
  table = std::move(product);
  return {};
}

Result<PointsTable> grid_points(const EvalOptions& options, bsdf::Quantity quantity) {
  CUTICLE_TRY(check_grid(options, quantity));
  PointsTable table{{}, {{}}};
  for (std::size_t c = 0; c < coordinates; ++c)
    if (!options.grid[c].empty()) CUTICLE_TRY(multiply(table, c, options.grid[c]));
  return table;
}

Result<PointsTable> file_points(const EvalOptions& options, bsdf::Quantity quantity) {
  for (std::size_t c = 0; c < coordinates; ++c)
    if (!options.grid[c].empty()) return usage_error(fmt::format("{} and --points exclude each other", flag(c)));
  CUTICLE_ASSIGN(PointsTable table, read_points(options.points_file, columns));
  for (std::size_t c = 0; c < coordinates; ++c)
    if (needed(quantity)[c] && std::find(table.columns.begin(), table.columns.end(), c) == table.columns.end())
      return bad_input(
          fmt::format("{}: no column {}, which {} needs", options.points_file, columns[c].name, options.quantity));
  return table;
}

std::vector<bsdf::Point> in_radians(const PointsTable& table) {
  std::vector<bsdf::Point> points(table.rows.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::size_t column = table.columns[c];
      points[i].*members[column] = table.rows[i][c] * (columns[column].unit == "deg" ? std::numbers::pi / 180 : 1);
    }
  return points;
}

/// The values of one model and lobe at all points.
struct Series {
  std::string_view model;
  std::string lobe;
  std::vector<glm::dvec3> values;
};

Result<void> evaluate_on(const EvalOptions& options, const Context& context, const bsdf::Model& model,
                         const registry::ParameterValues& values, const bsdf::Request& request,
                         std::span<glm::dvec3> out) {
  if (options.precision != "gpu")
    return bsdf::evaluate(model, values, options.precision == "f32" ? bsdf::Precision::f32 : bsdf::Precision::f64,
                          request, out);
#ifdef CUTICLE_HAS_GPU
  CUTICLE_ASSIGN(const std::shared_ptr<gpu::Device> device, gpu::Device::open({context.device}));
  return bsdf::evaluate_gpu(*device, model, values, request, out);
#else
  static_cast<void>(context);
  return usage_error("--precision gpu: this build has no GPU kernels", "--precision f32");
#endif
}

Result<std::vector<Series>> evaluate_all(const EvalOptions& options, const Context& context, bsdf::Quantity quantity,
                                         const std::vector<bsdf::Point>& points) {
  std::vector<Series> all;
  for (const std::string& name : split_list(options.models)) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    CUTICLE_ASSIGN(const registry::ParameterValues values,
                   bsdf::parse_settings(*model, options.preset, options.settings));
    for (const std::string& lobe : split_list(options.lobes)) {
      CUTICLE_ASSIGN(const int index, bsdf::find_lobe(*model, lobe));
      Series series{model->entry.name, lobe, std::vector<glm::dvec3>(points.size())};
      CUTICLE_TRY(evaluate_on(options, context, *model, values, {quantity, index, points}, series.values));
      all.push_back(std::move(series));
    }
  }
  return all;
}

/// A number with as many digits as the precision has.
std::string in_digits(double value, const std::string& precision) {
  return precision == "f64" ? fmt::format("{:.17g}", value) : fmt::format("{:.9g}", value);
}

std::string csv(const EvalOptions& options, const PointsTable& table, const std::vector<Series>& all) {
  const bool several = split_list(options.models).size() > 1;
  std::string text = several ? "model," : "";
  for (std::size_t column : table.columns) text += fmt::format("{},", columns[column].name);
  text += "lobe,r,g,b\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const Series& series : all) {
      if (several) text += fmt::format("{},", series.model);
      for (double value : table.rows[i]) text += fmt::format("{},", value);
      const glm::dvec3 rgb = series.values[i];
      text += fmt::format("{},{},{},{}\n", series.lobe, in_digits(rgb.x, options.precision),
                          in_digits(rgb.y, options.precision), in_digits(rgb.z, options.precision));
    }
  return text;
}

std::string json(const PointsTable& table, const std::vector<Series>& all) {
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const Series& series : all) {
      const glm::dvec3 rgb = series.values[i];
      nlohmann::json row = {{"model", series.model}, {"lobe", series.lobe}, {"r", rgb.x}, {"g", rgb.y}, {"b", rgb.z}};
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        row[std::string(columns[table.columns[c]].name)] = table.rows[i][c];
      rows.push_back(std::move(row));
    }
  return rows.dump(1) + "\n";
}

Result<std::string> evaluated_text(const EvalOptions& options, const Context& context) {
  CUTICLE_ASSIGN(const bsdf::Quantity quantity, bsdf::find_quantity(options.quantity));
  CUTICLE_ASSIGN(const PointsTable table,
                 options.points_file.empty() ? grid_points(options, quantity) : file_points(options, quantity));
  CUTICLE_ASSIGN(const std::vector<Series> all, evaluate_all(options, context, quantity, in_radians(table)));
  return context.json ? json(table, all) : csv(options, table, all);
}

int eval(const EvalOptions& options, const Context& context) {
  const Result<std::string> text = evaluated_text(options, context);
  if (!text) return report(text.error());
  if (options.out.empty()) {
    fmt::print("{}", *text);
    return Exit::ok;
  }
  if (const auto written = write_text_file(options.out, *text); !written) return report(written.error());
  return Exit::ok;
}

}  // namespace

void add_eval(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("eval", "a model's terms at points or on a grid, as CSV; angles in degrees");
  auto options = std::make_shared<EvalOptions>();
  command->add_option("--model,--models", options->models, "models, a,b,c (cuticle models)")->capture_default_str();
  command->add_option("--set", options->settings, "parameters, name=value,name=value, over the preset or the defaults");
  command->add_option("--preset", options->preset, "a starting point of the model, for example blonde");
  command->add_option("--quantity", options->quantity, "S, M, N, A or albedo")->capture_default_str();
  command->add_option("--lobe", options->lobes, "lobes of the model, or sum: R,TT,TRT,sum")->capture_default_str();
  for (std::size_t c = 0; c < coordinates; ++c)
    command->add_option(flag(c), options->grid[c],
                        c == 4 ? "offsets in fibre radii, a,b,c or from:to:count" : "degrees, a,b,c or from:to:count");
  command->add_option("--points", options->points_file, "CSV with columns theta_i, theta_o, theta_d, phi (degrees), h");
  command->add_option("--precision", options->precision, "f32, f64 or gpu")
      ->check(CLI::IsMember({"f32", "f64", "gpu"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "write to this file instead of stdout");
  command->callback([&context, options] { context.action = [&context, options] { return eval(*options, context); }; });
}

}  // namespace cuticle::cli
