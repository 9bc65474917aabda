#include "viz/lobe_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "lut/cell_average.h"

namespace cuticle::viz {
namespace {

double mean(const glm::dvec3& rgb) { return (rgb.x + rgb.y + rgb.z) / 3; }

/// Weights of the columns around one (their spread is 1.2 columns): a ridge one column wide would show the grid.
constexpr std::array<double, 7> k_weights = {1.0 / 64, 6.0 / 64, 15.0 / 64, 20.0 / 64, 15.0 / 64, 6.0 / 64, 1.0 / 64};

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

/// S at the view's theta_i; an interval's inclination is theta_o.
lut::Source source_of(const LobesView& view) {
  const lut::Evaluate evaluate = [&view](const bsdf::Request& request, std::span<glm::dvec3> out) {
    std::vector<bsdf::Point> points;
    for (const bsdf::Point& at : request.points)
      points.push_back({.theta_i = view.theta_i, .theta_o = at.theta_d, .phi = at.phi});
    return bsdf::evaluate(*view.model, view.values, bsdf::Precision::f64, {bsdf::Quantity::S, request.lobe, points},
                          out);
  };
  return {view.model, evaluate, evaluate};
}

std::vector<lut::PhiInterval> columns_of(const DirectionGrid& grid) {
  const double half = (grid.phi(1) - grid.phi(0)) / 2;
  std::vector<lut::PhiInterval> cells;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      cells.push_back({grid.theta_o(row), grid.phi(column) - half, grid.phi(column) + half});
  return cells;
}

/// S of one lobe on the grid: the mean over colour, and over about three degrees of phi, because of a caustic, which is
/// an infinite peak, only a mean can be drawn.
Result<std::vector<double>> lobe_values(const LobesView& view, const DirectionGrid& grid, int lobe) {
  const lut::Channel channel{"S", bsdf::Quantity::S, view.model->lobes[std::size_t(lobe)], 0, lut::Texel::cell_average};
  const lut::Source source = source_of(view);
  CUTICLE_ASSIGN(const lut::PhiAverages averages, lut::average_over_phi(source, channel, columns_of(grid)));
  std::vector<double> values;
  std::transform(averages.values.begin(), averages.values.end(), std::back_inserter(values), mean);
  for (int row = 0; row < grid.rows; ++row)
    blend(std::span(values).subspan(std::size_t(row) * std::size_t(grid.columns), std::size_t(grid.columns)));
  return values;
}

Result<std::vector<std::vector<double>>> all_lobe_values(const LobesView& view, const DirectionGrid& grid) {
  std::vector<std::vector<double>> lobes;
  for (int lobe = 0; lobe < int(view.model->lobes.size()); ++lobe) {
    CUTICLE_ASSIGN(lobes.emplace_back(), lobe_values(view, grid, lobe));
  }
  return lobes;
}

std::vector<double> sum_of(const std::vector<std::vector<double>>& lobes) {
  std::vector<double> sum(lobes[0].size(), 0.0);
  for (const auto& lobe : lobes)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += lobe[i];
  return sum;
}

double high_percentile(std::vector<double> values) {
  const auto rank = values.begin() + std::ptrdiff_t(0.999 * double(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return *rank > 0 ? *rank : 1;
}

LobeSurface make_surface(const LobesView& view, const LobeSurfaces& set, std::string name,
                         const std::vector<double>& values) {
  LobeSurface surface{std::move(name), {}, {}};
  for (int row = 0; row < set.grid.rows; ++row)
    for (int column = 0; column < set.grid.columns; ++column) {
      const double value = values[std::size_t(row) * set.grid.columns + column];
      const double theta = set.grid.theta_o(row), phi = set.grid.phi(column);
      surface.positions.push_back(
          surface_radius(value, set.peak, view.logarithmic) *
          glm::dvec3(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), std::sin(theta)));
    }
  return surface;
}

/// Colours of the lobes, mixed by what each gives to the sum.
std::vector<glm::dvec3> mixed_colors(const LobesView& view, const std::vector<std::vector<double>>& lobes) {
  std::vector<glm::dvec3> colors(lobes[0].size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    double total = 1e-300;
    for (std::size_t lobe = 0; lobe < lobes.size(); ++lobe) {
      colors[i] += lobe_color(view.model->lobes[lobe]) * lobes[lobe][i];
      total += lobes[lobe][i];
    }
    colors[i] /= total;
  }
  return colors;
}

void add_sum(const LobesView& view, const std::vector<std::vector<double>>& lobes, LobeSurfaces& set) {
  set.surfaces.push_back(make_surface(view, set, "sum", sum_of(lobes)));
  set.surfaces.back().colors = mixed_colors(view, lobes);
}

}  // namespace

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
      {"R", {0.20, 0.47, 0.75}},         {"TT", {0.93, 0.60, 0.13}},      {"TRT", {0.75, 0.22, 0.27}},
      {"residual", {0.35, 0.62, 0.36}},  {"TTs", {0.97, 0.80, 0.52}},     {"TRTs", {0.86, 0.55, 0.59}},
      {"specular", {0.20, 0.47, 0.75}},  {"primary", {0.20, 0.47, 0.75}}, {"diffuse", {0.93, 0.60, 0.13}},
      {"secondary", {0.75, 0.22, 0.27}}};
  const auto found = colors.find(lobe);
  return found == colors.end() ? glm::dvec3(0.5) : found->second;
}

Result<LobeSurfaces> make_surfaces(const LobesView& view) {
  LobeSurfaces set;
  CUTICLE_ASSIGN(const auto lobes, all_lobe_values(view, set.grid));
  set.peak = high_percentile(view.lobe >= 0 ? lobes[std::size_t(view.lobe)] : sum_of(lobes));
  if (view.lobe == -1) add_sum(view, lobes, set);
  for (int lobe = 0; lobe < int(lobes.size()); ++lobe) {
    if (view.lobe != LobesView::k_all_lobes && view.lobe != lobe) continue;
    set.surfaces.push_back(
        make_surface(view, set, std::string(view.model->lobes[std::size_t(lobe)]), lobes[std::size_t(lobe)]));
    set.surfaces.back().colors.assign(set.grid.size(), lobe_color(view.model->lobes[std::size_t(lobe)]));
  }
  return set;
}

}  // namespace cuticle::viz
