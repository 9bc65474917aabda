#pragma once
// Angles as the unit vectors that bsdf/batch takes.
#include <array>
#include <span>
#include <vector>

#include "bsdf/batch/batch.h"

namespace cuticle::python {

/// Vectors of points in planes of their own, in float: the viewer's azimuth is phi_o, the light's phi_o - phi. A buffer
/// that keeps its memory.
class UnitVectors {
 public:
  /// Within 4e-7 of the exact vectors (test_models.py compares S with that of the formulas one by one).
  void set(std::span<const bsdf::Point> points);
  bsdf::BatchPoints points() const;

 private:
  std::span<const float> plane(std::size_t k) const { return {planes_.data() + k * count_, count_}; }

  std::vector<float> planes_;  ///< x, y, z of the light and of the viewer, h
  std::size_t count_ = 0;
};

}  // namespace cuticle::python
