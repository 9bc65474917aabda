#pragma once
// How much a value moves with its stored inputs: what rounding them may cost, whatever the formula does afterwards.
// GLM_FORCE_XYZW_ONLY must be defined before anything includes glm: its unions cannot hold a Jet.
#include <cmath>
#include <limits>

#include <ceres/jet.h>

#include "bsdf/shared/evaluation.glslh"
#include "bsdf/shared/prepared.glslh"

namespace cuticle::tests {

/// A value (red) and its relative condition number: the sum over inputs x of |x df/dx| / |f|.
struct Conditioned {
  double value = 0, kappa = 0;
};

/// `evaluate` is a model's, called as evaluate(prepared, quantity, lobe, at) with Jets: the inputs are the prepared
/// numbers and the six coordinates of the point.
template <template <class> class Prepared, class Evaluate>
Conditioned condition_number(const Prepared<double>& prepared, int quantity, int lobe,
                             const bsdf::EvaluationPoint<double>& at, const Evaluate& evaluate) {
  constexpr int first = int(bsdf::number_count<Prepared>);
  using Jet = ceres::Jet<double, first + 6>;
  const auto values = bsdf::numbers_of<double>(prepared);
  std::array<Jet, std::size_t(first)> inputs;
  for (int k = 0; k < first; ++k) inputs[std::size_t(k)] = Jet(values[std::size_t(k)], k);
  const bsdf::EvaluationPoint<Jet> point{Jet(at.theta_i, first),   Jet(at.theta_o, first + 1), Jet(at.theta_d, first + 2),
                                         Jet(at.phi, first + 3),   Jet(at.h, first + 4),       Jet(at.phi_o, first + 5)};
  const Jet result = evaluate(bsdf::from_numbers<Prepared<Jet>>(inputs.data()), quantity, lobe, point).x;
  double moved = 0;
  for (int k = 0; k < first; ++k) moved += std::abs(values[std::size_t(k)] * result.v[k]);
  const double coordinates[6] = {at.theta_i, at.theta_o, at.theta_d, at.phi, at.h, at.phi_o};
  for (int k = 0; k < 6; ++k) moved += std::abs(coordinates[k] * result.v[first + k]);
  return {result.a, result.a == 0 ? 0 : moved / std::abs(result.a)};
}

/// The relative error that a closed form may have in a precision: 16 eps (1 + kappa).
template <class Real>
double allowed_error(double kappa) {
  return 16 * double(std::numeric_limits<Real>::epsilon()) * (1 + kappa);
}

}  // namespace cuticle::tests
