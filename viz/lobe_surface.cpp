#include <cuticle/viz/lobe_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace cuticle::viz {
namespace {

double mean(const glm::dvec3& rgb) { return (rgb.x + rgb.y + rgb.z) / 3; }

/// Samples of S across each column: a caustic is an infinite peak, of which only a mean can be drawn.
constexpr int k_samples = 16;

std::vector<bsdf::Point> row_points(const LobesView& view, const DirectionGrid& grid, int row) {
  const double step = grid.phi(1) - grid.phi(0);
  std::vector<bsdf::Point> points;
  for (int column = 0; column < grid.columns; ++column)
    for (int k = 0; k < k_samples; ++k)
      points.push_back({.theta_i = view.theta_i, .theta_o = grid.theta_o(row), .phi = grid.phi(column) + step * ((k + 0.5) / k_samples - 0.5)});
  return points;
}

/// S of one lobe on the grid: the mean over colour and over the column's step in phi.
Result<std::vector<double>> lobe_values(const LobesView& view, const DirectionGrid& grid, int lobe) {
  std::vector<double> values;
  for (int row = 0; row < grid.rows; ++row) {
    const std::vector<bsdf::Point> points = row_points(view, grid, row);
    std::vector<glm::dvec3> rgb(points.size());
    CUTICLE_TRY(bsdf::evaluate(*view.model, view.values, bsdf::Precision::f64, {bsdf::Quantity::S, lobe, points}, rgb));
    for (auto first = rgb.begin(); first != rgb.end(); first += k_samples)
      values.push_back(std::transform_reduce(first, first + k_samples, 0.0, std::plus<>(), mean) / k_samples);
  }
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

LobeSurface make_surface(const LobesView& view, const LobeSurfaces& set, std::string name, const std::vector<double>& values) {
  LobeSurface surface{std::move(name), {}, {}};
  for (int row = 0; row < set.grid.rows; ++row)
    for (int column = 0; column < set.grid.columns; ++column) {
      const double value = values[std::size_t(row) * set.grid.columns + column];
      const double theta = set.grid.theta_o(row), phi = set.grid.phi(column);
      surface.positions.push_back(surface_radius(value, set.peak, view.logarithmic) *
                                  glm::dvec3(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), std::sin(theta)));
    }
  return surface;
}

/// Colours of the lobes, mixed by what each gives to the sum.
std::vector<glm::dvec3> mixed_colors(const std::vector<std::vector<double>>& lobes) {
  std::vector<glm::dvec3> colors(lobes[0].size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    double total = 1e-300;
    for (std::size_t lobe = 0; lobe < lobes.size(); ++lobe) {
      colors[i] += lobe_color(int(lobe)) * lobes[lobe][i];
      total += lobes[lobe][i];
    }
    colors[i] /= total;
  }
  return colors;
}

void add_sum(const LobesView& view, const std::vector<std::vector<double>>& lobes, LobeSurfaces& set) {
  set.surfaces.push_back(make_surface(view, set, "sum", sum_of(lobes)));
  set.surfaces.back().colors = mixed_colors(lobes);
}

}  // namespace

double DirectionGrid::theta_o(int row) const { return (double(row) / (rows - 1) - 0.5) * std::numbers::pi; }
double DirectionGrid::phi(int column) const { return (2.0 * column / (columns - 1) - 1) * std::numbers::pi; }

double surface_radius(double value, double peak, bool logarithmic) {
  if (!(value > 0)) return 0;
  const double radius = logarithmic ? 1 + std::log10(value / peak) / k_decades : value / peak;
  return std::clamp(radius, 0.0, 1.0);
}

glm::dvec3 lobe_color(int lobe) {
  static const std::array<glm::dvec3, 4> colors = {{{0.20, 0.47, 0.75}, {0.93, 0.60, 0.13}, {0.75, 0.22, 0.27}, {0.35, 0.62, 0.36}}};
  return colors[std::size_t(lobe) % colors.size()];
}

Result<LobeSurfaces> make_surfaces(const LobesView& view) {
  LobeSurfaces set;
  CUTICLE_ASSIGN(const auto lobes, all_lobe_values(view, set.grid));
  set.peak = high_percentile(view.lobe >= 0 ? lobes[std::size_t(view.lobe)] : sum_of(lobes));
  if (view.lobe == -1) add_sum(view, lobes, set);
  for (int lobe = 0; lobe < int(lobes.size()); ++lobe) {
    if (view.lobe != LobesView::k_all_lobes && view.lobe != lobe) continue;
    set.surfaces.push_back(make_surface(view, set, std::string(view.model->lobes[std::size_t(lobe)]), lobes[std::size_t(lobe)]));
    set.surfaces.back().colors.assign(set.grid.size(), lobe_color(lobe));
  }
  return set;
}

}  // namespace cuticle::viz
