#pragma once
// One cubic span of a fibre, in double: where a line enters it.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "strands/curve_kind.h"

namespace cuticle::strands {

/// Centre and radius (w) along the span: a[0] + a[1] u + a[2] u^2 + a[3] u^3, u in [0, 1].
struct CurveSpan {
  std::array<glm::dvec4, 4> a{};

  glm::dvec4 at(double u) const { return a[0] + u * (a[1] + u * (a[2] + u * a[3])); }
  glm::dvec4 slope(double u) const { return a[1] + u * (2.0 * a[2] + 3 * u * a[3]); }
  glm::dvec4 bend(double u) const { return 2.0 * a[2] + 6 * u * a[3]; }
};

/// Of four control points; of the first two where the basis is linear.
inline CurveSpan curve_span(SplineBasis basis, const std::array<glm::dvec4, 4>& p) {
  switch (basis) {
    case SplineBasis::linear:
      return {{p[0], p[1] - p[0], {}, {}}};
    case SplineBasis::bezier:
      return {{p[0], 3.0 * (p[1] - p[0]), 3.0 * (p[0] - 2.0 * p[1] + p[2]), p[3] - p[0] + 3.0 * (p[1] - p[2])}};
    case SplineBasis::b_spline:
      return {{(p[0] + 4.0 * p[1] + p[2]) / 6.0, (p[2] - p[0]) / 2.0, (p[0] - 2.0 * p[1] + p[2]) / 2.0,
               (p[3] - p[0] + 3.0 * (p[1] - p[2])) / 6.0}};
    case SplineBasis::catmull_rom:
      break;
  }
  return {{p[1], (p[2] - p[0]) / 2.0, p[0] - 2.5 * p[1] + 2.0 * p[2] - 0.5 * p[3],
           (p[3] - p[0] + 3.0 * (p[1] - p[2])) / 2.0}};
}

struct Line {
  glm::dvec3 origin, direction;  ///< unit
};
/// Where a line meets a span.
struct CurveHit {
  double distance = 0, u = 0;
};

/// Where the line comes nearest to the span's middle, by Newton's method from `u`, kept inside the span.
inline CurveHit nearest_to_curve(const CurveSpan& span, const Line& line, double u) {
  for (int step = 0; step < 16; ++step) {
    const glm::dvec3 away = glm::dvec3(span.at(u)) - line.origin, slope(span.slope(u)), bend(span.bend(u));
    const double along = glm::dot(away, line.direction), turn = glm::dot(slope, line.direction);
    const double falls = glm::dot(away, slope) - along * turn;
    const double curves =
        glm::dot(slope, slope) - turn * turn + glm::dot(away, bend) - along * glm::dot(bend, line.direction);
    if (!(curves > 0)) break;
    const double next = std::clamp(u - falls / curves, 0.0, 1.0);
    if (std::abs(next - u) < 1e-13) break;
    u = next;
  }
  return {glm::dot(glm::dvec3(span.at(u)) - line.origin, line.direction), u};
}

/// Newton's method for |p - c(u)|^2 = r(u)^2 on the envelope of the spheres: (p - c) . c' + r r' = 0. None where it
/// does not settle on the span, or on the side that the line leaves by.
inline std::optional<CurveHit> entry_from(const CurveSpan& span, const Line& line, CurveHit hit) {
  constexpr double k_beyond = 1e-7;  ///< of the span's ends, so that no line slips between two spans
  for (int step = 0; step < 16; ++step) {
    const glm::dvec4 centre = span.at(hit.u), slope = span.slope(hit.u), bend = span.bend(hit.u);
    const glm::dvec3 away = line.origin + hit.distance * line.direction - glm::dvec3(centre), tangent(slope);
    const double radius = centre.w, apart = glm::dot(away, away) - radius * radius;
    const double across = glm::dot(away, tangent) + radius * slope.w;
    const double apart_by_t = 2 * glm::dot(away, line.direction), apart_by_u = -2 * across;
    const double across_by_t = glm::dot(line.direction, tangent);
    const double across_by_u =
        glm::dot(away, glm::dvec3(bend)) - glm::dot(tangent, tangent) + slope.w * slope.w + radius * bend.w;
    const double determinant = apart_by_t * across_by_u - apart_by_u * across_by_t;
    if (determinant == 0 || !std::isfinite(determinant)) return std::nullopt;
    const double t = (apart_by_u * across - across_by_u * apart) / determinant;
    const double u = (across_by_t * apart - apart_by_t * across) / determinant;
    hit.distance += t;
    hit.u += u;
    if (!(std::abs(hit.u - 0.5) < 2)) return std::nullopt;
    if (std::abs(t) > 1e-9 * radius) continue;
    if (hit.u < -k_beyond || hit.u > 1 + k_beyond) return std::nullopt;
    hit.u = std::clamp(hit.u, 0.0, 1.0);
    if (!(apart_by_t < 0)) return std::nullopt;
    return hit;
  }
  return std::nullopt;
}

/// Where the line enters a round span near `guess`; none: it passes beside it.
inline std::optional<CurveHit> round_entry(const CurveSpan& span, const Line& line, const CurveHit& guess) {
  if (const auto hit = entry_from(span, line, guess)) return hit;
  const CurveHit nearest = nearest_to_curve(span, line, guess.u);
  const glm::dvec4 centre = span.at(nearest.u);
  const glm::dvec3 slope(span.slope(nearest.u));
  const glm::dvec3 apart = line.origin + nearest.distance * line.direction - glm::dvec3(centre);
  const double inside = centre.w * centre.w - glm::dot(apart, apart), length = glm::length(slope);
  if (!(inside > 0) || !(length > 0)) return std::nullopt;
  const double cosine = glm::dot(slope, line.direction) / length;
  const double back = std::sqrt(inside / std::max(1e-12, 1 - cosine * cosine));
  return entry_from(span, line, {nearest.distance - back, nearest.u - back * cosine / length});
}

/// Where the line meets the ribbon that faces it.
inline std::optional<CurveHit> flat_entry(const CurveSpan& span, const Line& line, const CurveHit& guess) {
  const CurveHit nearest = nearest_to_curve(span, line, guess.u);
  const glm::dvec4 centre = span.at(nearest.u);
  const glm::dvec3 apart = line.origin + nearest.distance * line.direction - glm::dvec3(centre);
  if (!(glm::dot(apart, apart) < centre.w * centre.w)) return std::nullopt;
  return nearest;
}

/// How far the line runs in the straight tube of the span's width at `u`; at most a hundred radii.
inline double leaves_tube_at(const CurveSpan& span, const Line& line, double u) {
  const glm::dvec4 centre = span.at(u);
  const glm::dvec3 slope(span.slope(u)), away = line.origin - glm::dvec3(centre);
  const double longest = 100 * centre.w, length = glm::length(slope);
  if (!(length > 0)) return longest;
  const glm::dvec3 tangent = slope / length;
  const glm::dvec3 across = line.direction - glm::dot(line.direction, tangent) * tangent;
  const glm::dvec3 from = away - glm::dot(away, tangent) * tangent;
  const double square = glm::dot(across, across), middle = glm::dot(from, across);
  const double rest = std::max(0.0, middle * middle - square * (glm::dot(from, from) - centre.w * centre.w));
  if (!(square > 0)) return longest;
  return std::clamp((std::sqrt(rest) - middle) / square, 0.0, longest);
}

}  // namespace cuticle::strands
