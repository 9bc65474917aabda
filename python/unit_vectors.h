#pragma once
// Angles as the unit vectors that bsdf/batch takes.
#include <span>
#include <vector>

#include "bsdf/batch/batch.h"

namespace cuticle::python {

/// Vectors of points in planes of their own, in float: the viewer's azimuth is phi_o, the light's phi_o - phi. A buffer
/// that keeps its memory.
class UnitVectors {
 public:
  /// `columns`: theta_i, theta_o, phi, phi_o in degrees and h, each `count` numbers, one after the other. Within 4e-7
  /// of the exact vectors (test_models.py compares S with that of the formulas in double).
  void set(std::span<const double> columns, std::size_t count);
  bsdf::BatchPoints points() const;

 private:
  std::span<const float> plane(std::size_t k) const { return {planes_.data() + k * count_, count_}; }

  std::vector<float> planes_;  ///< x, y, z of the light and of the viewer, h
  std::vector<double> zeros_;
  std::size_t count_ = 0;
};

}  // namespace cuticle::python
