#pragma once
// Numerical integration on the CPU, in double: Gauss-Legendre rules of any order, and an adaptive rule with an error estimate.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/expect.h"

namespace cuticle {

/// Nodes in (-1, 1), rising, and their weights (sum 2).
struct QuadratureRule {
  std::vector<double> nodes, weights;
};

/// The Gauss-Legendre rule of `order` points (1 .. 10000), by Newton's method on the recurrence of the Legendre polynomials.
/// Exact for polynomials of degree 2 order - 1; nodes and weights within 4e-16 and 2e-15 of mpmath (core/quadrature_test.cpp).
QuadratureRule gauss_legendre(int order);

/// The integral of `function` over [lower, upper] by a rule.
template <class Function>
double integrate(const QuadratureRule& rule, double lower, double upper, const Function& function) {
  const double middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
  double sum = 0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) sum += rule.weights[k] * function(middle + half * rule.nodes[k]);
  return sum * half;
}

struct Tolerance {
  double absolute = 0, relative = 1e-10;
  std::size_t evaluations = 100000;  ///< at most so many calls of the integrand (at least 15 are made)
};
struct Integral {
  double value = 0;
  double error = 0;                  ///< estimated absolute error, an upper bound for smooth integrands
  std::size_t evaluations = 0;
  bool converged = false;            ///< error <= max(absolute, relative |value|)
};

/// Adaptive Gauss-Kronrod integration (7 and 15 points): the interval with the largest error is halved until the sum of the
/// errors meets the tolerance. Values that are not finite count as 0, so an integrable end-point singularity is no error.
Integral integrate_adaptive(const std::function<double(double)>& function, double lower, double upper,
                            const Tolerance& tolerance = {});

}  // namespace cuticle
