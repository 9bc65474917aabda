// `cuticle fit`: parameters of one or more models from a CSV of lobes, as `cuticle eval` writes it.
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include "cli/command.h"
#include "cli/eval/coordinates.h"
#include "core/json/json.h"
#include "lut/fit/measured_fit.h"

namespace cuticle::cli {
namespace {

struct FitOptions {
  std::string file, models = "marschner", free, settings, preset, quantity = "S", lobe = "sum", loss = "squares";
  std::string measured, format;
  double theta_o_deg = -30;
};

/// Columns beyond those of `cuticle eval`, in this order after them.
enum Column : std::size_t {
  lobe_column = bsdf::coordinate_count,
  r_column,
  g_column,
  b_column,
  value_column,
  sigma_column
};

/// The file's rows, with the lobes' names as they stand in it.
struct Table {
  PointsTable points;
  std::vector<std::string_view> lobes;

  std::optional<std::size_t> place(std::size_t column) const {
    const auto found = std::ranges::find(points.columns, column);
    if (found == points.columns.end()) return {};
    return std::size_t(found - points.columns.begin());
  }
  double cell(std::size_t row, std::size_t column, double otherwise) const {
    const auto at = place(column);
    return at ? points.rows[row][*at] : otherwise;
  }
};

Result<Table> read_table(const FitOptions& options, const bsdf::Model& model) {
  constexpr double most = 1e30;
  Table table{{}, {"sum"}};
  table.lobes.insert(table.lobes.end(), model.lobes.begin(), model.lobes.end());
  std::vector<PointColumn> known(eval_columns.begin(), eval_columns.end());
  known.push_back({"lobe", 0, 0, "1", table.lobes});
  for (const char* name : {"r", "g", "b", "value"}) known.push_back({name, -most, most, "1"});
  known.push_back({"sigma", 0, most, "1"});
  CUTICLE_ASSIGN(table.points, read_points(options.file, known));
  return table;
}

Result<void> check_columns(const FitOptions& options, const Table& table, const bsdf::Model& model,
                           const registry::ParameterValues& values, bsdf::Quantity quantity) {
  const auto needed = bsdf::coordinates_of(model, values, quantity);
  for (std::size_t c = 0; c < needed.size(); ++c)
    if (needed[c] && eval_columns[c].name != "phi_o" && !table.place(c))
      return bad_input(fmt::format("{}: no column {}, which {} of {} needs", options.file, eval_columns[c].name,
                                   options.quantity, model.entry.name));
  const bool rgb = table.place(r_column) && table.place(g_column) && table.place(b_column);
  if (rgb == bool(table.place(value_column)))
    return bad_input(fmt::format("{}: the measured numbers are columns r, g, b, or one column value", options.file));
  return {};
}

Result<lut::Measurements> measurements(const FitOptions& options, const Table& table, const bsdf::Model& model,
                                       bsdf::Quantity quantity) {
  lut::Measurements data;
  data.quantity = quantity;
  data.one_number = bool(table.place(value_column));
  data.sigma_known = bool(table.place(sigma_column));
  PointsTable places;
  for (std::size_t c = 0; c < bsdf::coordinate_count; ++c)
    if (table.place(c)) places.columns.push_back(c);
  for (std::size_t i = 0; i < table.points.rows.size(); ++i) {
    places.rows.emplace_back();
    for (std::size_t column : places.columns) places.rows.back().push_back(table.cell(i, column, 0));
  }
  const std::vector<bsdf::Point> points = in_radians(places);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto lobe = table.place(lobe_column) ? table.lobes[std::size_t(table.cell(i, lobe_column, 0))]
                                               : std::string_view(options.lobe);
    CUTICLE_ASSIGN(const int index, bsdf::find_lobe(model, lobe));
    const double one = table.cell(i, value_column, 0);
    data.rows.push_back({points[i],
                         index,
                         {table.cell(i, r_column, one), table.cell(i, g_column, one), table.cell(i, b_column, one)},
                         table.cell(i, sigma_column, 0)});
  }
  return data;
}

Result<lut::ModelFit> fit_one(const FitOptions& options, const std::string& name, const std::string& free) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
  CUTICLE_ASSIGN(const registry::ParameterValues start, bsdf::parse_settings(*model, options.preset, options.settings));
  CUTICLE_ASSIGN(const bsdf::Quantity quantity, bsdf::find_quantity(options.quantity));
  CUTICLE_ASSIGN(const lut::Loss loss, lut::find_loss(options.loss));
  CUTICLE_ASSIGN(const Table table, read_table(options, *model));
  CUTICLE_TRY(check_columns(options, table, *model, start, quantity));
  CUTICLE_ASSIGN(const lut::Measurements data, measurements(options, table, *model, quantity));
  return lut::fit_model({model, start, split_list(free), loss}, data);
}

/// The model's list of free names: the lists of several models are separated by a semicolon, one list serves all.
Result<std::vector<lut::ModelFit>> fit_all(const FitOptions& options) {
  const std::vector<std::string> names = split_list(options.models);
  std::vector<std::string> free(1);
  for (char c : options.free) {
    if (c == ';')
      free.emplace_back();
    else
      free.back() += c;
  }
  if (free.size() != 1 && free.size() != names.size())
    return usage_error(fmt::format("--free: {} lists for {} models", free.size(), names.size()),
                       "one list, or one for each model: eta,beta;color,roughness");
  std::vector<lut::ModelFit> fits;
  for (std::size_t i = 0; i < names.size(); ++i) {
    CUTICLE_ASSIGN(lut::ModelFit fit, fit_one(options, names[i], free[free.size() == 1 ? 0 : i]));
    fits.push_back(std::move(fit));
  }
  return fits;
}

void print(const lut::ModelFit& fit) {
  fmt::print("{}: {} numbers, rms residual {:.4g}, AIC {:.2f}{}\n", fit.model->entry.name, fit.numbers, fit.residual,
             fit.aic, fit.converged ? "" : ", not converged");
  fmt::print("{:<22}{:>14}{:>12}{:>28}  correlations\n", "parameter", "value", "1 sigma", "95 % interval");
  const std::size_t count = fit.parameters.size();
  for (std::size_t i = 0; i < count; ++i) {
    const lut::FittedParameter& p = fit.parameters[i];
    fmt::print("{:<22}{:>14.6g}{:>12.3g}{:>14.6g}{:>14.6g} ", p.name, p.value, p.sigma,
               p.value - fit.interval * p.sigma, p.value + fit.interval * p.sigma);
    for (std::size_t j = 0; j <= i; ++j) fmt::print("{:>7.3f}", fit.correlations[i * count + j]);
    fmt::print("{}\n", p.at_bound ? "  at the end of its range" : "");
  }
}

void print_refusal(const lut::ModelFit& fit) {
  for (const auto& group : fit.inseparable)
    if (group.size() == 1)
      fmt::print(stderr, "cuticle: {}: these data do not depend on {}\n", fit.model->entry.name, group[0]);
    else
      fmt::print(stderr, "cuticle: {}: these data cannot tell {} apart\n", fit.model->entry.name,
                 fmt::join(group, ", "));
  fmt::print(stderr, "cuticle: try: fix them with --set, or measure where they act\n");
}

/// A measured fibre: each model fitted to half of its directions, judged on the others.
Result<std::vector<lut::ModelFit>> fit_measured(const FitOptions& options, const Context& context) {
  CUTICLE_ASSIGN(const bsdf::MeasuredFibre fibre,
                 bsdf::read_measured(options.measured, options.format, {glm::radians(options.theta_o_deg)}));
  CUTICLE_ASSIGN(const lut::Loss loss, lut::find_loss(options.loss));
  if (!context.json)
    fmt::print("{}: {} measured directions, {} without a value; every second one is fitted, the others judge\n",
               options.measured, fibre.directions.size(), fibre.unmeasured);
  std::vector<lut::ModelFit> fits;
  const std::vector<std::string> free = options.free.empty() ? std::vector<std::string>{} : split_list(options.free);
  for (const std::string& name : split_list(options.models)) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    CUTICLE_ASSIGN(lut::MeasuredModel found,
                   lut::fit_measured({model, free, options.preset, options.settings, loss}, fibre));
    if (!context.json)
      fmt::print("{}: factor {:.4g}; rms error over rms: all {:.3f}, R {:.3f}, TT {:.3f}, TRT {:.3f}\n", name,
                 found.fit.scale, lut::judged_error(found, fibre), lut::judged_error(found, fibre, lut::LobeZone::r),
                 lut::judged_error(found, fibre, lut::LobeZone::tt),
                 lut::judged_error(found, fibre, lut::LobeZone::trt));
    fits.push_back(std::move(found.fit));
  }
  return fits;
}

int fit(const FitOptions& options, const Context& context) {
  if (options.measured.empty() == options.file.empty())
    return report(usage_error("fit: one of DATA.csv and --measured FILE", "a goniometer's file is --measured FILE"));
  if (options.measured.empty() && options.free.empty()) return report(usage_error("--free: no parameter is free"));
  const auto fits = options.measured.empty() ? fit_all(options) : fit_measured(options, context);
  if (!fits) return report(fits.error());
  Json json = Json::list();
  bool refused = false;
  const lut::ModelFit* best = nullptr;
  for (const lut::ModelFit& one : *fits) {
    json.push_back(lut::to_json(one));
    if (!one.inseparable.empty()) print_refusal(one);
    if (one.inseparable.empty() && !context.json) print(one);
    if (one.inseparable.empty() && (!best || one.aic < best->aic)) best = &one;
    refused |= !one.inseparable.empty() || !one.converged;
  }
  if (context.json) fmt::print("{}\n", json.dump(2));
  if (!context.json && best && fits->size() > 1)
    for (const lut::ModelFit& one : *fits)
      if (one.inseparable.empty())
        fmt::print("{:<16} AIC - lowest {:.2f}\n", one.model->entry.name, one.aic - best->aic);
  return refused ? Exit::check_failed : Exit::ok;
}

}  // namespace

void add_fit(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("fit", "fit a model's parameters to measured or simulated lobes");
  auto options = std::make_shared<FitOptions>();
  command->add_option("data", options->file,
                      "CSV as eval writes it: angles in degrees, lobe (optional), r,g,b or value, sigma (optional)");
  command->add_option(
      "--measured", options->measured,
      "a measured fibre instead: goniometer text (phi theta value), CSV or a table of slices; models are "
      "fitted up to a factor to half of its directions and judged on the others");
  command->add_option("--format", options->format, "of --measured: gantry, csv or slices; else by the file's name");
  command
      ->add_option("--theta-o", options->theta_o_deg,
                   "of a gantry's file: inclination of the arm that stands still, degrees")
      ->check(CLI::Range(-89.9, 89.9))
      ->capture_default_str();
  command->add_option("--model,--models", options->models, "models to fit and compare, a,b,c")->capture_default_str();
  command->add_option(
      "--free", options->free,
      "parameters to find, a,b,c; one list for each model as a,b;c,d; with --measured, none: those that S tells");
  command->add_option("--set", options->settings, "fixed parameters and starting values, name=value,name=value");
  command->add_option("--preset", options->preset,
                      "the pigment of blond, brown or black hair over the model's defaults");
  command->add_option("--quantity", options->quantity, "what was measured: S, M, N, A or albedo")
      ->capture_default_str();
  command->add_option("--lobe", options->lobe, "the lobe measured, or sum; where the file has no column lobe")
      ->capture_default_str();
  command->add_option("--loss", options->loss, "squares, huber or cauchy")->capture_default_str();
  command->callback([&context, options] { context.action = [&context, options] { return fit(*options, context); }; });
}

}  // namespace cuticle::cli
