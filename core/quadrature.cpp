#include "core/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cuticle {
namespace {

struct Legendre {
  double value, slope;
};

/// P_n and its derivative at x by the three-term recurrence; |x| < 1.
Legendre legendre(int order, double x) {
  double before = 1, value = x;
  for (int k = 2; k <= order; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, order * (x * value - before) / (x * x - 1)};
}

/// Root `k` of P_n, counted from +1, from Tricomi's asymptotic guess.
double legendre_root(int order, int k) {
  double x = std::cos(std::numbers::pi * (k + 0.75) / (order + 0.5));
  for (int step = 0; step < 20; ++step) {
    const Legendre p = legendre(order, x);
    const double change = p.value / p.slope;
    x -= change;
    if (std::abs(change) < 1e-16) break;
  }
  return x;
}

struct KronrodNode {
  double node, kronrod, gauss;
};
/// From core/reference/fit_gauss_kronrod.py; the mirrored nodes are left out.
constexpr std::array<KronrodNode, 8> k_kronrod = {{
    {0.0, 0.209482141084727828, 0.417959183673469388},
    {0.207784955007898468, 0.204432940075298892, 0},
    {0.405845151377397167, 0.19035057806478541, 0.381830050505118945},
    {0.58608723546769113, 0.169004726639267903, 0},
    {0.74153118559939444, 0.140653259715525919, 0.279705391489276668},
    {0.864864423359769073, 0.104790010322250184, 0},
    {0.949107912342758525, 0.0630920926299785533, 0.129484966168869693},
    {0.991455371120812639, 0.022935322010529225, 0},
}};

struct Interval {
  double lower, upper, value, error;
};
bool less_error(const Interval& a, const Interval& b) { return a.error < b.error; }

double finite_value(const std::function<double(double)>& function, double x) {
  const double value = function(x);
  return std::isfinite(value) ? value : 0.0;
}

Interval measure(const std::function<double(double)>& function, double lower, double upper) {
  const double middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
  double kronrod = 0, gauss = 0;
  for (const KronrodNode& k : k_kronrod) {
    double pair = finite_value(function, middle + half * k.node);
    if (k.node > 0) pair += finite_value(function, middle - half * k.node);
    kronrod += k.kronrod * pair;
    gauss += k.gauss * pair;
  }
  return {lower, upper, kronrod * half, std::abs((kronrod - gauss) * half)};
}

Integral total(const std::vector<Interval>& intervals, const Tolerance& tolerance) {
  Integral sum;
  for (const Interval& interval : intervals) {
    sum.value += interval.value;
    sum.error += interval.error;
  }
  sum.evaluations = 15 * (2 * intervals.size() - 1);
  sum.converged = sum.error <= std::max(tolerance.absolute, tolerance.relative * std::abs(sum.value));
  return sum;
}

}  // namespace

QuadratureRule gauss_legendre(int order) {
  CUTICLE_EXPECT(order >= 1 && order <= 10000, "a Gauss-Legendre rule has 1 .. 10000 points");
  if (order == 1) return {{0.0}, {2.0}};
  QuadratureRule rule{std::vector<double>(std::size_t(order)), std::vector<double>(std::size_t(order))};
  for (int k = 0; 2 * k < order; ++k) {
    const double x = 2 * k + 1 == order ? 0.0 : legendre_root(order, k);
    const double slope = legendre(order, x).slope;
    const std::size_t high = std::size_t(order - 1 - k);
    rule.nodes[high] = x;
    rule.nodes[std::size_t(k)] = -x;
    rule.weights[high] = rule.weights[std::size_t(k)] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

Integral integrate_adaptive(const std::function<double(double)>& function, double lower, double upper, const Tolerance& tolerance) {
  std::vector<Interval> heap = {measure(function, lower, upper)};
  Integral sum = total(heap, tolerance);
  while (!sum.converged && sum.evaluations + 30 <= tolerance.evaluations) {
    std::pop_heap(heap.begin(), heap.end(), less_error);
    const Interval worst = heap.back();
    const double middle = 0.5 * (worst.lower + worst.upper);
    if (!(middle > std::min(worst.lower, worst.upper) && middle < std::max(worst.lower, worst.upper))) break;
    heap.back() = measure(function, worst.lower, middle);
    std::push_heap(heap.begin(), heap.end(), less_error);
    heap.push_back(measure(function, middle, worst.upper));
    std::push_heap(heap.begin(), heap.end(), less_error);
    sum = total(heap, tolerance);
  }
  return sum;
}

}  // namespace cuticle
