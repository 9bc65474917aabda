#include "bsdf/dual_scattering/dual_scattering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "bsdf/shared/adaptive_quadrature.glslh"
#include "bsdf/turns.h"
#include "core/expect.h"
#include "core/quadrature.h"

namespace cuticle::bsdf {
namespace {

using glm::dvec3;
using std::numbers::pi;
constexpr int first_panels = 16, deepest = 9, nodes_in_theta = 15;
constexpr double tolerance = 1e-5;
constexpr int effort = 2;  ///< times the paths of a model that walks

/// Sums over one half of the azimuths of S cos(theta_i), and of it times theta_i + theta_o and its square.
struct HalfMoments {
  std::array<dvec3, 3> of{};
  void add(double weight, double sum, dvec3 value) {
    of[0] += weight * value;
    of[1] += weight * sum * value;
    of[2] += weight * sum * sum * value;
  }
};
struct Moments {
  HalfMoments forward, backward;
};

Moments operator+(Moments a, const Moments& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    a.forward.of[k] += b.forward.of[k];
    a.backward.of[k] += b.backward.of[k];
  }
  return a;
}

/// Azimuths with weights, by 24 Gauss points in each quarter, and offsets, even in their angles, with weights that add
/// up to 1.
struct QuadratureDirections {
  std::vector<double> phi, phi_weight, h, h_weight;
};
QuadratureDirections quadrature_directions(bool near_field) {
  QuadratureDirections d;
  const QuadratureRule rule = gauss_legendre(24);
  for (int quarter = 0; quarter < 4; ++quarter)
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      d.phi.push_back((quarter - 1.5 + rule.nodes[k] / 2) * pi / 2);
      d.phi_weight.push_back(rule.weights[k] * pi / 4);
    }
  const QuadratureRule across = gauss_legendre(near_field ? 16 : 1);
  for (std::size_t k = 0; k < across.nodes.size(); ++k) {
    d.h.push_back(std::sin(across.nodes[k] * pi / 2));
    d.h_weight.push_back(near_field ? across.weights[k] * std::cos(across.nodes[k] * pi / 2) * pi / 4 : 1);
  }
  return d;
}

/// The integrand of one model from one viewer.
class Integrand {
 public:
  Integrand(const Model& model, const registry::ParameterValues& values, double theta_o)
      : model_(model),
        values_(values),
        theta_o_(theta_o),
        directions_(quadrature_directions(model.near_field && model.near_field(values))) {}

  /// Halving panels does not make the noise of walks smaller.
  bool halves() const { return model_.scattering_from_viewer == nullptr; }

  /// Moments over a panel of theta_i by 15 points, and the difference of its two shares by 7 of them.
  Result<std::pair<Moments, dvec3>> panel(double low, double high) const {
    std::vector<Point> points;
    for (int k = 0; k < nodes_in_theta; ++k) append(points, theta_at(low, high, k));
    std::vector<dvec3> values(points.size());
    CUTICLE_ASSIGN(const bool together, scattering_from_viewers(model_, values_, effort, -1, points, values));
    if (!together) CUTICLE_TRY(evaluate(model_, values_, Precision::f64, {Quantity::S, -1, points}, values));
    return summed(points, values, low, high);
  }

 private:
  static double theta_at(double low, double high, int k) {
    return (low + high) / 2 + (high - low) / 2 * kronrod_node(1.0, k).x;
  }
  void append(std::vector<Point>& points, double theta_i) const {
    for (double h : directions_.h)
      for (double phi : directions_.phi)
        points.push_back({.theta_i = theta_i, .theta_o = theta_o_, .phi = phi, .h = h});
  }
  std::pair<Moments, dvec3> summed(const std::vector<Point>& points, const std::vector<dvec3>& values, double low,
                                   double high) const {
    Moments fine;
    dvec3 coarse(0);
    const std::size_t turn = directions_.phi.size(), each = turn * directions_.h.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const dvec3 node = kronrod_node(1.0, int(i / each));
      const double area = (high - low) / 2 * std::cos(points[i].theta_i) * directions_.phi_weight[i % turn] *
                          directions_.h_weight[i % each / turn];
      HalfMoments& half = std::abs(points[i].phi) > pi / 2 ? fine.forward : fine.backward;
      half.add(area * node.y, points[i].theta_i + theta_o_, values[i]);
      coarse += area * node.z * values[i];
    }
    return {fine, glm::abs(fine.forward.of[0] + fine.backward.of[0] - coarse)};
  }

  const Model& model_;
  const registry::ParameterValues& values_;
  double theta_o_;
  QuadratureDirections directions_;
};

double largest(dvec3 v) { return std::max(v.x, std::max(v.y, v.z)); }

struct Total {
  Moments moments;
  dvec3 error{0};
};

/// Panels that are halved until the two rules agree to their share of the tolerance.
Result<Total> adaptive(const Integrand& integrand, double low, double high, int depth) {
  Total total;
  CUTICLE_ASSIGN(auto panel, integrand.panel(low, high));
  if (largest(panel.second) <= tolerance * (high - low) / pi || depth >= deepest || !integrand.halves())
    return Total{panel.first, panel.second};
  CUTICLE_ASSIGN(Total left, adaptive(integrand, low, (low + high) / 2, depth + 1));
  CUTICLE_ASSIGN(Total right, adaptive(integrand, (low + high) / 2, high, depth + 1));
  total.moments = left.moments + right.moments;
  total.error = left.error + right.error;
  return total;
}

HalfScattering half_scattering(const HalfMoments& moments) {
  HalfScattering half;
  half.share = moments.of[0];
  for (int c = 0; c < 3; ++c) {
    if (half.share[c] <= 0) continue;
    half.shift[c] = moments.of[1][c] / half.share[c];
    half.deviation[c] = std::sqrt(std::max(0.0, moments.of[2][c] / half.share[c] - half.shift[c] * half.shift[c]));
  }
  return half;
}

/// One colour of the paper's sums, with r = a_b / (1 - a_f^2).
struct Sums {
  double attenuation, shift, deviation;
};
Sums sums_of(const AverageScattering& a, int c, double density) {
  const double forward = a.forward.share[c], backward = a.backward.share[c];
  if (backward <= 0) return {0, 0, 0};
  const double squared = forward * forward, gap = (1 - forward) * (1 + forward), r = backward / gap;
  const double f = a.forward.deviation[c], b = a.backward.deviation[c], cubed = backward * backward * backward;
  const double once = std::sqrt(2 * f * f + b * b), thrice = std::sqrt(2 * f * f + 3 * b * b);
  return {squared * (r + r * r * r),
          a.backward.shift[c] * (1 - 2 * r * r) + a.forward.shift[c] * (2 + 4 * squared * r * r) / gap,
          (1 + density * squared) * (backward * once + cubed * thrice) / (backward + cubed * (2 * f + 3 * b))};
}

HalfScattering between(const HalfScattering& below, const HalfScattering& above, double share) {
  const glm::dvec3 variance = glm::mix(below.deviation * below.deviation, above.deviation * above.deviation, share);
  return {glm::mix(below.share, above.share, share), glm::mix(below.shift, above.shift, share), glm::sqrt(variance)};
}

}  // namespace

DualScatteringRow DualScatteringTable::at(double theta) const {
  CUTICLE_EXPECT(!rows.empty(), "a table has rows");
  const double last = double(rows.size() - 1);
  const double place = std::clamp((theta / pi + 0.5) * double(rows.size()) - 0.5, 0.0, last);
  const auto row = std::min(std::size_t(place), rows.size() - 1);
  const DualScatteringRow &below = rows[row], &above = rows[std::min(row + 1, rows.size() - 1)];
  const double share = place - double(row);
  const auto half_of = [](const MultipleBackscattering& m) {
    return HalfScattering{m.attenuation, m.shift, m.deviation};
  };
  const HalfScattering multiple = between(half_of(below.multiple), half_of(above.multiple), share);
  return {.theta = theta,
          .average = {.forward = between(below.average.forward, above.average.forward, share),
                      .backward = between(below.average.backward, above.average.backward, share),
                      .error = glm::max(below.average.error, above.average.error)},
          .multiple = {multiple.share, multiple.shift, multiple.deviation}};
}

/// A flat fibre's average is that over turns of its cross-section; two turns are exact for a cubic in the index, and a
/// sum over all azimuths is smooth in it.
constexpr int k_turns = 2;

Result<AverageScattering> average_scattering(const Model& model, const registry::ParameterValues& values,
                                             double theta_o) {
  if (!(std::abs(theta_o) <= pi / 2 * (1 + 1e-12)))
    return bad_input(fmt::format("theta_o = {} is outside -pi/2 .. pi/2 rad", theta_o));
  const registry::ParameterValues averaged = over_turns(values, k_turns);
  const Integrand integrand(model, averaged, theta_o);
  Moments moments;
  AverageScattering average;
  for (int k = 0; k < first_panels; ++k) {
    const double low = pi * (double(k) / first_panels - 0.5), high = pi * (double(k + 1) / first_panels - 0.5);
    CUTICLE_ASSIGN(const Total total, adaptive(integrand, low, high, 0));
    moments = moments + total.moments;
    average.error += total.error;
  }
  average.forward = half_scattering(moments.forward);
  average.backward = half_scattering(moments.backward);
  return average;
}

Result<MultipleBackscattering> multiple_backscattering(const AverageScattering& average, double density) {
  MultipleBackscattering result;
  for (int c = 0; c < 3; ++c) {
    if (average.forward.share[c] >= 1 && average.backward.share[c] > 0)
      return bad_input(fmt::format("forward share {} leaves no bound on what comes back; it must be below 1",
                                   average.forward.share[c]));
    const Sums sums = sums_of(average, c, density);
    result.attenuation[c] = sums.attenuation;
    result.shift[c] = sums.shift;
    result.deviation[c] = sums.deviation;
  }
  return result;
}

Result<DualScatteringTable> dual_scattering_terms(const Model& model, const registry::ParameterValues& values,
                                                  int count) {
  if (count < 1 || count > 4096) return bad_input(fmt::format("count = {} is outside 1 .. 4096", count));
  DualScatteringTable table;
  for (int k = 0; k < count; ++k) {
    DualScatteringRow row;
    row.theta = pi * ((k + 0.5) / count - 0.5);
    CUTICLE_ASSIGN(row.average, average_scattering(model, values, row.theta));
    const auto multiple = multiple_backscattering(row.average);
    if (!multiple.ok()) return bad_input(fmt::format("theta = {}: {}", row.theta, multiple.error().message));
    row.multiple = *multiple;
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace cuticle::bsdf
