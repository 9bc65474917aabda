#include "viz/lobes/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lut/cell_average.h"
#include "viz/color/ramp.h"
#include "viz/lobes/numbers.h"

namespace cuticle::viz {
namespace {

/// Weights of the columns around one (their spread is 1.2 columns): a ridge one column wide would show the grid.
constexpr std::array<double, 7> k_weights = {1.0 / 64, 6.0 / 64, 15.0 / 64, 20.0 / 64, 15.0 / 64, 6.0 / 64, 1.0 / 64};

/// How often that is done: so that the spread is about 2.4 degrees. A ridge lies askew over the grid, and of less its
/// saw teeth show.
int blends_of(const DirectionGrid& grid) {
  const double degrees = 360.0 / (grid.columns - 1);
  return std::max(1, int(4 / (degrees * degrees) + 0.5));
}

/// The row's values with its columns blended; first and last column are the same direction.
void blend(std::span<double> row) {
  const int period = int(row.size()) - 1;
  const std::vector<double> sharp(row.begin(), row.end());
  for (int column = 0; column <= period; ++column) {
    row[std::size_t(column)] = 0;
    for (int k = 0; k < int(k_weights.size()); ++k)
      row[std::size_t(column)] += k_weights[std::size_t(k)] * sharp[std::size_t((column + k - 3 + period) % period)];
  }
}

/// Times the paths of a model that walks: rows have paths of their own, and a surface shows their noise.
constexpr int k_effort = 32;

/// S at the light's inclination; an interval's inclination is theta_o.
lut::Source source_of(const ShownModel& shown, const LobeSettings& settings) {
  const lut::Evaluate evaluate = [&shown, &settings](const bsdf::Request& request, std::span<glm::dvec3> out) {
    std::vector<bsdf::Point> points;
    for (const bsdf::Point& at : request.points)
      points.push_back({.theta_i = settings.theta_i, .theta_o = at.theta_d, .phi = at.phi, .h = settings.h});
    return bsdf::evaluate(*shown.model, shown.values, bsdf::Precision::f64, {bsdf::Quantity::S, request.lobe, points},
                          out);
  };
  return {shown.model, evaluate, evaluate};
}

std::vector<lut::PhiInterval> columns_of(const DirectionGrid& grid) {
  const double half = (grid.phi(1) - grid.phi(0)) / 2;
  std::vector<lut::PhiInterval> cells;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      cells.push_back({grid.theta_o(row), grid.phi(column) - half, grid.phi(column) + half});
  return cells;
}

Result<std::vector<double>> averaged_values(const ShownModel& shown, const LobeSettings& settings,
                                            const DirectionGrid& grid, int lobe) {
  const lut::Channel channel{"S", bsdf::Quantity::S, shown.model->lobes[std::size_t(lobe)], 0,
                             lut::Texel::cell_average};
  const lut::Source source = source_of(shown, settings);
  CUTICLE_ASSIGN(const lut::PhiAverages averages, lut::average_over_phi(source, channel, columns_of(grid)));
  std::vector<double> values;
  std::transform(averages.values.begin(), averages.values.end(), std::back_inserter(values), mean);
  for (int row = 0; row < blends_of(grid) * grid.rows; ++row)
    blend(
        std::span(values).subspan(std::size_t(row % grid.rows) * std::size_t(grid.columns), std::size_t(grid.columns)));
  return values;
}

Result<std::vector<double>> point_values(const ShownModel& shown, const LobeSettings& settings,
                                         const DirectionGrid& grid, int lobe, bsdf::Precision precision) {
  std::vector<bsdf::Point> points;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      points.push_back(
          {.theta_i = settings.theta_i, .theta_o = grid.theta_o(row), .phi = grid.phi(column), .h = settings.h});
  std::vector<glm::dvec3> colors(points.size());
  CUTICLE_ASSIGN(const bool together,
                 bsdf::scattering_from_viewers(*shown.model, shown.values, k_effort, lobe, points, colors));
  if (!together)
    CUTICLE_TRY(bsdf::evaluate(*shown.model, shown.values, precision, {bsdf::Quantity::S, lobe, points}, colors));
  std::vector<double> values;
  std::transform(colors.begin(), colors.end(), std::back_inserter(values), mean);
  return values;
}

double high_percentile(std::vector<double> values) {
  const auto rank = values.begin() + std::ptrdiff_t(0.999 * double(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return *rank > 0 ? *rank : 1;
}

glm::dvec3 direction(const DirectionGrid& grid, int row, int column) {
  const double theta = grid.theta_o(row), phi = grid.phi(column);
  return {std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), std::sin(theta)};
}

LobeSurface make_surface(const DirectionGrid& grid, std::string name, const std::vector<double>& values, double peak,
                         bool logarithmic) {
  LobeSurface surface{std::move(name), {}, {}};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double value = values[std::size_t(row) * std::size_t(grid.columns) + std::size_t(column)];
      surface.positions.push_back(surface_radius(value, peak, logarithmic) * direction(grid, row, column));
    }
  return surface;
}

/// Colours of the lobes, mixed by what each gives to the sum.
std::vector<glm::dvec3> mixed_colors(const LobeValues& lobes) {
  std::vector<glm::dvec3> colors(lobes.grid.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    double total = 1e-300;
    for (std::size_t lobe = 0; lobe < lobes.lobes.size(); ++lobe) {
      colors[i] += lobe_color(lobes.lobes[lobe]) * lobes.values[lobe][i];
      total += lobes.values[lobe][i];
    }
    colors[i] /= total;
  }
  return colors;
}

}  // namespace

std::vector<double> LobeValues::sum() const {
  std::vector<double> total(values[0].size(), 0.0);
  for (const auto& lobe : values)
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += lobe[i];
  return total;
}

Result<LobeValues> lobe_values(const ShownModel& shown, const LobeSettings& settings, const DirectionGrid& grid,
                               bool averaged) {
  const bsdf::Precision precision = averaged ? bsdf::Precision::f64 : bsdf::Precision::f32;
  averaged = averaged && shown.model->azimuthal_means;  // of the others, none has an infinite peak
  LobeValues found{grid, {}, {}};
  for (int lobe = 0; lobe < int(shown.model->lobes.size()); ++lobe) {
    CUTICLE_ASSIGN(found.values.emplace_back(), averaged ? averaged_values(shown, settings, grid, lobe)
                                                         : point_values(shown, settings, grid, lobe, precision));
    found.lobes.emplace_back(shown.model->lobes[std::size_t(lobe)]);
  }
  return found;
}

double scattered(const DirectionGrid& grid, const std::vector<double>& values) {
  const double row_step = grid.theta_o(1) - grid.theta_o(0), column_step = grid.phi(1) - grid.phi(0);
  double sum = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column)
      sum += std::cos(grid.theta_o(row)) * values[std::size_t(row) * std::size_t(grid.columns) + std::size_t(column)];
  return sum * row_step * column_step;
}

double peak_of(const LobeValues& values, const std::string& shown_lobe) {
  const auto found = std::find(values.lobes.begin(), values.lobes.end(), shown_lobe);
  return high_percentile(found == values.lobes.end() ? values.sum()
                                                     : values.values[std::size_t(found - values.lobes.begin())]);
}

double DirectionGrid::theta_o(int row) const { return (double(row) / (rows - 1) - 0.5) * std::numbers::pi; }
double DirectionGrid::phi(int column) const { return (2.0 * column / (columns - 1) - 1) * std::numbers::pi; }

double surface_radius(double value, double peak, bool logarithmic) {
  if (!(value > 0)) return 0;
  const double radius = logarithmic ? 1 + std::log10(value / peak) / k_decades : value / peak;
  return std::clamp(radius, 0.0, 1.0);
}

glm::dvec3 lobe_color(std::string_view lobe) {
  // The same as LOBE_COLORS of python/cuticle_report/figures.py.
  static const std::map<std::string_view, glm::dvec3> colors = {
      {"R", {0.20, 0.47, 0.75}},        {"TT", {0.93, 0.60, 0.13}},      {"TRT", {0.75, 0.22, 0.27}},
      {"residual", {0.35, 0.62, 0.36}}, {"TTs", {0.97, 0.80, 0.52}},     {"TRTs", {0.86, 0.55, 0.59}},
      {"specular", {0.20, 0.47, 0.75}}, {"primary", {0.20, 0.47, 0.75}}, {"diffuse", {0.93, 0.60, 0.13}},
      {"secondary", {0.75, 0.22, 0.27}}};
  const auto found = colors.find(lobe);
  return found == colors.end() ? glm::dvec3(0.5) : found->second;
}

Result<std::vector<LobeSurface>> make_surfaces(const LobeValues& values, const LobeSettings& settings, double peak) {
  std::vector<LobeSurface> surfaces;
  if (settings.lobe == "sum") {
    surfaces.push_back(make_surface(values.grid, "sum", values.sum(), peak, settings.logarithmic));
    surfaces.back().colors = mixed_colors(values);
  }
  for (std::size_t lobe = 0; lobe < values.lobes.size(); ++lobe) {
    if (settings.lobe != "all" && settings.lobe != values.lobes[lobe]) continue;
    surfaces.push_back(make_surface(values.grid, values.lobes[lobe], values.values[lobe], peak, settings.logarithmic));
    surfaces.back().colors.assign(values.grid.size(), lobe_color(values.lobes[lobe]));
  }
  if (surfaces.empty())
    return usage_error(fmt::format("--lobe {}: the model has {}", settings.lobe, fmt::join(values.lobes, ", ")),
                       "all, sum, or one of these");
  return surfaces;
}

LobeSurface difference_surface(const LobeValues& first, const LobeValues& second, const LobeSettings& settings,
                               double peak) {
  const std::vector<double> a = first.sum(), b = second.sum();
  std::vector<double> larger(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) larger[i] = std::max(a[i], b[i]);
  LobeSurface surface = make_surface(first.grid, "difference", larger, peak, settings.logarithmic);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double share = (b[i] - a[i]) / std::max(a[i] + b[i], 1e-300);
    surface.colors.push_back(ramp_color(Ramp::diverging, 0.5 + 0.5 * share));
  }
  return surface;
}

}  // namespace cuticle::viz
