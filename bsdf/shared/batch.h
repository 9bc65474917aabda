#pragma once
// What every model's CPU batch loop needs: numbers narrowed to the precision asked for, points made ready for the
// formulas.
#include <cmath>

#include <cuticle/bsdf/model.h>
#include <cuticle/bsdf/shared/evaluation.glslh>
#include <cuticle/bsdf/shared/packing.glslh>

namespace cuticle::bsdf {

/// The numbers of a model, prepared in double, in the precision of a batch.
template <class Real>
Packed<Real> narrow(const Packed<double>& packed) {
  Packed<Real> narrowed;
  for (int i = 0; i < CUTICLE_PACKED_COUNT; ++i) narrowed.value[i] = Real(packed.value[i]);
  return narrowed;
}

/// A point in the precision of a batch; phi is brought to [-pi, pi] in double first, so that no digit is lost to turns.
template <class Real>
EvaluationPoint<Real> narrow(const Point& point) {
  constexpr double turn = 6.283185307179586;
  return {Real(point.theta_i), Real(point.theta_o), Real(point.theta_d), Real(std::remainder(point.phi, turn)),
          Real(point.h)};
}

}  // namespace cuticle::bsdf
