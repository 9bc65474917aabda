#include "study/model_check/sphere_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/quadrature.h"
#include "study/model_check/checks/checks.h"

namespace cuticle::study::model_check {
namespace {

constexpr int order = 6;
constexpr std::size_t points_per_cell = order * order;

/// Points and weights on [0, 1], and the weights that give the last two Legendre coefficients of a function.
struct CellRule {
  std::array<double, order> node{}, weight{};
  std::array<std::array<double, order>, 2> coefficient{};
};

CellRule make_rule() {
  const QuadratureRule gauss = gauss_legendre(order);
  CellRule rule;
  for (std::size_t k = 0; k < order; ++k) {
    rule.node[k] = 0.5 * (1 + gauss.nodes[k]);
    rule.weight[k] = 0.5 * gauss.weights[k];
    for (unsigned c = 0; c < 2; ++c) {
      const unsigned degree = order - 1 - c;
      rule.coefficient[c][k] = (2 * degree + 1) * rule.weight[k] * std::legendre(degree, gauss.nodes[k]);
    }
  }
  return rule;
}

const CellRule& cell_rule() {
  static const CellRule rule = make_rule();
  return rule;
}

using CellValues = std::array<glm::dvec3, points_per_cell>;

/// How much of the integrand the last coefficients along one direction still hold, averaged over the other.
double unresolved(const CellValues& values, bool along_phi) {
  const CellRule& rule = cell_rule();
  double sum = 0;
  for (std::size_t row = 0; row < order; ++row)
    for (const auto& coefficient : rule.coefficient) {
      double last = 0;
      for (std::size_t k = 0; k < order; ++k)
        last += coefficient[k] * brightness(values[along_phi ? row * order + k : k * order + row]);
      sum += rule.weight[row] * std::abs(last);
    }
  return sum;
}

/// Fills value, error and direction of a cell from the integrand at its points (theta outer, phi inner).
void assess(Cell& cell, const CellValues& values) {
  const CellRule& rule = cell_rule();
  const double area = (cell.theta_high - cell.theta_low) * (cell.phi_high - cell.phi_low);
  glm::dvec3 mean(0);
  double size = 0;
  for (std::size_t i = 0; i < points_per_cell; ++i) {
    const double weight = rule.weight[i / order] * rule.weight[i % order];
    mean += weight * values[i];
    size += weight * std::abs(brightness(values[i]));
  }
  const double theta = unresolved(values, false), phi = unresolved(values, true), worst = std::max(theta, phi);
  cell.value = area * mean;
  cell.along_phi = phi > theta;
  // A coefficient of degree n bounds one of degree 2 n, the first that the rule misses, by its square.
  cell.error = size > 0 ? area * worst * std::min(1.0, worst / size) : 0;
}

void append_points(const Cell& cell, const bsdf::Point& view, std::vector<bsdf::Point>& points) {
  for (double t : cell_rule().node)
    for (double p : cell_rule().node) {
      bsdf::Point point = view;
      point.theta_i = cell.theta_low + t * (cell.theta_high - cell.theta_low);
      point.phi = cell.phi_low + p * (cell.phi_high - cell.phi_low);
      point.theta_d = 0.5 * (point.theta_o - point.theta_i);
      points.push_back(point);
    }
}

/// What the integrand's own error at the middle of each cell amounts to.
void set_own_errors(std::span<Cell> cells, const Batch& own_error, const bsdf::Point& view) {
  if (!own_error) return;
  std::vector<bsdf::Point> points(cells.size(), view);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    points[c].theta_i = 0.5 * (cells[c].theta_low + cells[c].theta_high);
    points[c].phi = 0.5 * (cells[c].phi_low + cells[c].phi_high);
  }
  const std::vector<glm::dvec3> errors = values_at(own_error, points);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const double area = (cells[c].theta_high - cells[c].theta_low) * (cells[c].phi_high - cells[c].phi_low);
    cells[c].own_error = area * std::cos(points[c].theta_i) * largest(errors[c]);
  }
}

/// The integral of each cell and its error; one below the integrand's own is no reason to divide.
void measure(std::span<Cell> cells, const Batch& integrand, const bsdf::Point& view) {
  std::vector<bsdf::Point> points;
  points.reserve(cells.size() * points_per_cell);
  for (const Cell& cell : cells) append_points(cell, view, points);
  std::vector<glm::dvec3> values(points.size());
  integrand(points, values);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    CellValues own;
    for (std::size_t i = 0; i < points_per_cell; ++i)
      own[i] = values[c * points_per_cell + i] * std::cos(points[c * points_per_cell + i].theta_i);
    assess(cells[c], own);
    if (cells[c].error <= cells[c].own_error) cells[c].error = 0;
  }
}

std::pair<Cell, Cell> halves(const Cell& cell) {
  Cell low = cell, high = cell;
  if (cell.along_phi) {
    low.phi_high = high.phi_low = 0.5 * (cell.phi_low + cell.phi_high);
  } else {
    low.theta_high = high.theta_low = 0.5 * (cell.theta_low + cell.theta_high);
  }
  return {low, high};
}

using Seeds = std::vector<Seed>;
constexpr double least_width = 1e-6;  // of a cell [rad]

bool within(double place, double scale, double low, double high) {
  return scale > wide_lobe || (place >= low && place <= high);
}

/// The seeds of lobes that reach into a cell: by place, or along a ring or an arc.
Seeds inside(const Cell& cell, const Seeds& seeds) {
  Seeds held;
  std::copy_if(seeds.begin(), seeds.end(), std::back_inserter(held), [&](const Seed& seed) {
    return within(seed.theta, seed.theta_scale, cell.theta_low, cell.theta_high) &&
           within(seed.phi, seed.phi_scale, cell.phi_low, cell.phi_high);
  });
  return held;
}

/// How much more than chance explains the fullest eighth of the range holds; above 1 the values do not fill it.
double crowding(const std::vector<double>& values, double low, double high) {
  std::array<double, 8> counts{};
  for (double value : values) counts[std::size_t(std::clamp(8 * (value - low) / (high - low), 0.0, 7.0))] += 1;
  const double even = double(std::max<std::size_t>(values.size(), 1)) / 8;
  return *std::max_element(counts.begin(), counts.end()) / (2.2 * even + 3 * std::sqrt(even));
}

/// How urgently a range asks to be halved, above 1: it is many times wider than a seed's own scale, or its seeds crowd.
double urgency(const Seeds& seeds, double Seed::*place, double Seed::*scale, double low, double high, double scales) {
  if (seeds.empty() || high - low < least_width) return 0;
  std::vector<double> values;
  double least = 1;
  for (const Seed& seed : seeds) {
    if (seed.*scale <= wide_lobe) values.push_back(seed.*place);
    least = std::min(least, seed.*scale);
  }
  return std::max(6 * crowding(values, low, high), (high - low) / std::max(least, least_width)) / scales;
}

/// Halves a cell until the seeds in each part fill it.
void divide_around(const Cell& cell, const Seeds& seeds, double scales, std::vector<Cell>& cells) {
  const Seeds held = inside(cell, seeds);
  const double theta = urgency(held, &Seed::theta, &Seed::theta_scale, cell.theta_low, cell.theta_high, scales);
  const double phi = urgency(held, &Seed::phi, &Seed::phi_scale, cell.phi_low, cell.phi_high, scales);
  if (std::max(theta, phi) <= 1) {
    cells.push_back(cell);
    return;
  }
  Cell divided = cell;
  divided.along_phi = phi > theta;
  const auto [low, high] = halves(divided);
  divide_around(low, held, scales, cells);
  divide_around(high, held, scales, cells);
}

std::vector<Cell> first_cells(const Partition& partition) {
  std::vector<Cell> cells;
  for (std::size_t t = 0; t + 1 < partition.theta.size(); ++t)
    for (std::size_t p = 0; p + 1 < partition.phi.size(); ++p)
      divide_around({partition.theta[t], partition.theta[t + 1], partition.phi[p], partition.phi[p + 1]},
                    partition.seeds, partition.scales, cells);
  return cells;
}

double total_error(const std::vector<Cell>& cells) {
  double sum = 0;
  for (const Cell& cell : cells) sum += cell.error;
  return sum;
}

/// Sums up the cells, of which a partition may hold one half.
void add_up(SphereIntegral& integral, const Partition& partition, const SphereTolerance& tolerance) {
  const double copies = partition.even ? 2 : 1;
  integral.value = glm::dvec3(0);
  integral.own_error = 0;
  for (const Cell& cell : integral.cells) {
    integral.value += copies * cell.value;
    integral.own_error += copies * cell.own_error;
  }
  integral.error = copies * total_error(integral.cells);
  // To know the sum better than the integrand knows itself would be in vain.
  integral.converged = integral.error <= std::max(tolerance.absolute, 0.2 * integral.own_error);
}

/// Takes the cells that hold most of the error out of the list, worst first, and gives their halves.
std::vector<Cell> take_worst(std::vector<Cell>& cells, double total) {
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.error < b.error; });
  std::vector<Cell> divided;
  for (double taken = 0; taken < 0.8 * total && !cells.empty() && cells.back().error > 0; cells.pop_back()) {
    taken += cells.back().error;
    const auto [low, high] = halves(cells.back());
    divided.push_back(low);
    divided.push_back(high);
  }
  return divided;
}

}  // namespace

SphereIntegral integrate_sphere(const Batch& integrand, const bsdf::Point& view, const Partition& partition,
                                const SphereTolerance& tolerance) {
  SphereIntegral integral;
  integral.cells = first_cells(partition);
  set_own_errors(integral.cells, tolerance.own_error, view);
  add_up(integral, partition, tolerance);
  integral.converged = false;
  if (integral.own_error > tolerance.most_own_error) return integral;
  measure(integral.cells, integrand, view);
  integral.evaluations = integral.cells.size() * points_per_cell;
  add_up(integral, partition, tolerance);
  while (!integral.converged && integral.evaluations < tolerance.evaluations) {
    std::vector<Cell> divided = take_worst(integral.cells, total_error(integral.cells));
    if (divided.empty()) break;
    set_own_errors(divided, tolerance.own_error, view);
    measure(divided, integrand, view);
    integral.evaluations += divided.size() * points_per_cell;
    integral.cells.insert(integral.cells.end(), divided.begin(), divided.end());
    add_up(integral, partition, tolerance);
  }
  return integral;
}

SphereIntegral scattered_energy(const Scatterer& scatterer, const bsdf::Point& view, double absolute,
                                double most_own_error) {
  return integrate_sphere(scatterer.scattering, view, partition_for(scatterer, view),
                          {.absolute = absolute, .own_error = scatterer.error, .most_own_error = most_own_error});
}

}  // namespace cuticle::study::model_check
