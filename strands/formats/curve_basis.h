#pragma once
// Curves by control points, as pbrt and USD have them, and the polyline that a groom keeps of them.
#include <cstddef>
#include <span>
#include <vector>

#include "strands/curve_kind.h"

namespace cuticle::strands {

struct CurveBasis {
  using Kind = SplineBasis;
  Kind kind = Kind::linear;
  std::size_t degree = 3;  ///< of bezier and b_spline, 2 or 3
  bool pinned = false;     ///< b_spline and catmull_rom: the ends are control points mirrored at the first and last
};

/// Whether so many control points make a curve: bezier 1 + n degree, b_spline degree + 1 or more, ..
inline bool makes_a_curve(const CurveBasis& basis, std::size_t count) {
  switch (basis.kind) {
    case CurveBasis::Kind::linear:
      return count >= 2;
    case CurveBasis::Kind::bezier:
      return count > basis.degree && (count - 1) % basis.degree == 0;
    case CurveBasis::Kind::b_spline:
      return count + (basis.pinned ? 2 : 0) > basis.degree && (count > 1 || !basis.pinned);
    case CurveBasis::Kind::catmull_rom:
      return count + (basis.pinned ? 2 : 0) > 3;
  }
  return false;
}

/// The ends of a curve and the places where its polynomials join, of points or of values along it; `control` must make
/// a curve. Uniform knots: the b_spline's weights there are 1, 4, 1 over 6 (degree 3) and 1, 1 over 2 (degree 2).
template <class T>
std::vector<T> joints(const CurveBasis& basis, std::span<const T> control) {
  using Kind = CurveBasis::Kind;
  if (basis.kind == Kind::linear) return {control.begin(), control.end()};
  std::vector<T> result;
  if (basis.kind == Kind::bezier) {
    for (std::size_t i = 0; i < control.size(); i += basis.degree) result.push_back(control[i]);
    return result;
  }
  std::vector<T> points(control.begin(), control.end());
  if (basis.pinned) {
    points.insert(points.begin(), control[0] * 2.0f - control[1]);
    points.push_back(control.back() * 2.0f - control[control.size() - 2]);
  }
  const bool interpolates = basis.kind == Kind::catmull_rom;
  if (!interpolates && basis.degree == 2)
    for (std::size_t i = 1; i < points.size(); ++i) result.push_back(points[i - 1] * 0.5f + points[i] * 0.5f);
  else
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      result.push_back(interpolates ? points[i]
                                    : points[i - 1] * (1.0f / 6) + points[i] * (4.0f / 6) + points[i + 1] * (1.0f / 6));
  return result;
}

}  // namespace cuticle::strands
